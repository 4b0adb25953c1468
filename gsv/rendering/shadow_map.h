// The depth of the world as the sun sees it: one for each snapshot, whatever cameras look.
//
// What casts shadows and has not moved is drawn once. A second map has what moves as well; for each
// snapshot it is mended from the first where something moved and gets its new place, as far as the
// pictures' cameras may see the shadow of what moves.
// Covers all that casts shadows. Its edges are rounded, so that they stay where they are while
// robots drive about and shadows do not shimmer.
// Threads  the render thread only.
#pragma once

#include "gsv/rendering/draw_plan.h"
#include "gsv/rendering/frame_block.h"
#include "gsv/rendering/instance_buffer.h"

namespace gsv::rendering {

class ShadowMap {
 public:
  ShadowMap();

  // Draws the shadows of a posed plan for some cameras. `plan_id` tells plans apart.
  void Draw(const DrawPlan& plan, std::uint64_t plan_id, const geometry::Vector3& to_sun,
            const std::vector<CameraView>& views, InstanceBuffer& instances);

  // Whether some shadow may fall on a thing in this sphere; where none does, its lookup is saved.
  bool MayFallOn(const geometry::Vector3& centre, double radius) const;

  // Makes it current for shaders with SHADOWS.
  void Bind() const;
  // Fills in the shadow's part of the block for a camera at `origin`.
  void Describe(const geometry::Vector3& origin, FrameBlock& block) const;

 private:
  // A box along the sun's direction: columns right, up, towards the sun.
  struct Region {
    std::array<geometry::Vector3, 3> axes;
    geometry::Vector3 min, max;  // along the axes
    friend bool operator==(const Region&, const Region&) = default;
  };
  bool IsEmpty() const { return !(region_.min.x < region_.max.x); }

  double TexelSize() const;  // the longer side, m

  struct Drawn {
    std::uint64_t plan_id = 0;
    int moved_count = -1;
    Region region;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  struct Rectangle {  // texels, [min, max)
    int min_x, min_y, max_x, max_y;
  };

  // A region without an inside if nothing casts shadows.
  static Region RegionOf(const DrawPlan& plan, const geometry::Vector3& to_sun);
  // Indices of the still items that cast shadows.
  static std::vector<std::size_t> StillCasters(const DrawPlan& plan);
  // Of the items that move and cast shadows, those whose shadow one of the cameras may see.
  std::vector<std::size_t> MovingCasters(const DrawPlan& plan,
                                         const std::vector<CameraView>& views) const;
  // Around each body of some items.
  std::vector<Rectangle> PartsOf(const DrawPlan& plan, const std::vector<std::size_t>& items) const;
  void CopyStill(const Rectangle& part);
  void DrawCasters(const DrawPlan& plan, const std::vector<std::size_t>& casters,
                   InstanceBuffer& instances);

  GlTexture still_, moving_;
  GlFramebuffer still_frame_, moving_frame_;
  GlProgram solid_, cut_out_;
  Region region_;
  Drawn drawn_;                   // what still_ holds
  std::vector<Rectangle> moved_;  // where moving_ differs from still_
  std::vector<InstanceData> staged_;
};

}  // namespace gsv::rendering
