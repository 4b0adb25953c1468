// The light that eight pixels send to the camera: the same terms as in shaders.cc.
#pragma once

#include "gsv/rendering/raster/sun_shadow.h"
#include "gsv/rendering/raster/surface.h"
#include "gsv/rendering/scene/frame_block.h"

namespace gsv::rendering::raster {

// Lamps of the frame's block that reach some part of a picture.
struct Lamps {
  int count = 0;
  const LightBlock* lights[kMaxLights];
};

class LightModel {
 public:
  // `block` with its shadow's part; without `shadow` (null) everything is in the sun.
  LightModel(const FrameBlock& block, const SunShadow* shadow) : block_(block), shadow_(shadow) {}

  // Those that reach into a box, in the frame of FrustumOf().
  Lamps Reaching(const geometry::Vector3& min, const geometry::Vector3& max) const;

  // Tone-mapped, linear, in [0, 1].
  F8x3 Colour(const Surfaces& surfaces, const F8x3& ray, const Lamps& lamps) const;
  F8x3 Sky(const F8x3& ray) const;

 private:
  const FrameBlock& block_;
  const SunShadow* shadow_;
};

// Linear colours in [0, 1] to sRGB, with `alpha` (0 to 255) in the highest byte.
I8 Encoded(const F8x3& colour, I8 alpha);

}  // namespace gsv::rendering::raster
