// The region of a shadow map and its casters: a box along the direction of the sun around
// all casters. The edges of the box are rounded. So they are fixed while robots move, and shadows
// do not flicker.
#pragma once

#include <vector>

#include "gsv/rendering/scene/frame_block.h"
#include "gsv/rendering/scene/render_list.h"

namespace gsv::rendering {

inline constexpr int kShadowSide = 2048;  // side of the map in texels

// The box that a shadow map covers.
class ShadowRegion {
 public:
  // Makes an empty region, without casters.
  ShadowRegion() = default;
  // Makes the region around all casters of a posed render list.
  ShadowRegion(const RenderList& render_list, const geometry::Vector3& to_sun);

  // Whether there are no casters.
  bool IsEmpty() const { return !(min_.x < max_.x); }
  double TexelSize() const;  // the longer side of a texel, m

  // Whether a shadow may be in this sphere. If not, shadow look-ups are skipped.
  bool MayFallOn(const geometry::Vector3& centre, double radius) const;

  // Returns the indices of casters that have not moved.
  static std::vector<std::size_t> StillCasters(const RenderList& render_list);
  // Returns the indices of moving casters whose shadows a camera may see.
  std::vector<std::size_t> MovingCasters(const RenderList& render_list,
                                         const std::vector<CameraView>& views) const;

  struct Rectangle {  // a part of the map in texels, [min, max)
    int min_x, min_y, max_x, max_y;
  };
  // Returns the parts of the map around the bodies of some items, or the whole map if that is
  // cheaper.
  std::vector<Rectangle> PartsOf(const RenderList& render_list,
                                 const std::vector<std::size_t>& items) const;

  // Fills in the shadow parameters of the block for a camera at `origin`. The map has depths in [0,
  // 1], which grow towards the sun.
  void Describe(const geometry::Vector3& origin, FrameBlock& block) const;

  friend bool operator==(const ShadowRegion&, const ShadowRegion&) = default;

 private:
  std::array<geometry::Vector3, 3> axes_;  // to the right and up in the map, and towards the sun
  geometry::Vector3 min_, max_;            // minimum and maximum along axes_
};

}  // namespace gsv::rendering
