// The shading of eight pixels, with the same terms as in shaders.cc.
#pragma once

#include "gsv/rendering/raster/sun_shadow.h"
#include "gsv/rendering/raster/surface.h"
#include "gsv/rendering/scene/frame_block.h"

namespace gsv::rendering::raster {

// The lamps of the frame block that can light a part of the image.
struct Lamps {
  int count = 0;
  const LightBlock* lights[kMaxLights];
};

// Computes the colours of surfaces under the lights of an image.
class LightModel {
 public:
  // `block` must include the shadow parameters. If `shadow` is null, there are no shadows.
  LightModel(const FrameBlock& block, const SunShadow* shadow) : block_(block), shadow_(shadow) {}

  // Returns the lamps that can light points in a box, given in the frame of FrustumOf().
  Lamps Reaching(const geometry::Vector3& min, const geometry::Vector3& max) const;

  // Returns the tone-mapped linear colour in [0, 1]. Lanes outside `used` get any value.
  F8x3 Colour(const Surfaces& surfaces, const F8x3& ray, const Lamps& lamps, I8 used) const;
  // Returns the colour of the sky in these directions.
  F8x3 Sky(const F8x3& ray) const;

 private:
  const FrameBlock& block_;
  const SunShadow* shadow_;
};

// Encodes linear colours in [0, 1] as sRGB, with `alpha` (0 to 255) in the highest byte.
I8 Encoded(const F8x3& colour, I8 alpha);

}  // namespace gsv::rendering::raster
