// Where a shadow map lies and what is drawn into it: a box along the sun's direction that holds all
// that casts shadows. Its edges are rounded, so that they stay where they are while robots drive
// about and shadows do not shimmer.
#pragma once

#include <vector>

#include "gsv/rendering/scene/frame_block.h"
#include "gsv/rendering/scene/render_list.h"

namespace gsv::rendering {

inline constexpr int kShadowSide = 2048;  // texels

class ShadowRegion {
 public:
  // Nothing casts shadows.
  ShadowRegion() = default;
  // Around all of a posed plan that casts shadows.
  ShadowRegion(const RenderList& render_list, const geometry::Vector3& to_sun);

  bool IsEmpty() const { return !(min_.x < max_.x); }
  double TexelSize() const;  // the longer side, m

  // Whether some shadow may fall on a thing in this sphere; where none does, its lookup is saved.
  bool MayFallOn(const geometry::Vector3& centre, double radius) const;

  // Indices of the still items that cast shadows.
  static std::vector<std::size_t> StillCasters(const RenderList& render_list);
  // Of the items that move and cast shadows, those whose shadow one of the cameras may see.
  std::vector<std::size_t> MovingCasters(const RenderList& render_list,
                                         const std::vector<CameraView>& views) const;

  struct Rectangle {  // texels, [min, max)
    int min_x, min_y, max_x, max_y;
  };
  // Around each body of some items; everything when that is cheaper.
  std::vector<Rectangle> PartsOf(const RenderList& render_list,
                                 const std::vector<std::size_t>& items) const;

  // Fills in the shadow's part of the block for a camera at `origin`: the map holds [0, 1], depth
  // grows towards the sun.
  void Describe(const geometry::Vector3& origin, FrameBlock& block) const;

  friend bool operator==(const ShadowRegion&, const ShadowRegion&) = default;

 private:
  std::array<geometry::Vector3, 3> axes_;  // right, up, towards the sun
  geometry::Vector3 min_, max_;            // along the axes
};

}  // namespace gsv::rendering
