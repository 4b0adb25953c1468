// The depth of the world as the sun sees it: one for each snapshot, whatever cameras look.
//
// What casts shadows and has not moved is drawn once. A second map has what moves as well; for each
// snapshot it is mended from the first where something moved and gets its new place, as far as the
// pictures' cameras may see the shadow of what moves.
// Threads  the render thread only.
#pragma once

#include "gsv/rendering/opengl/instance_buffer.h"
#include "gsv/rendering/scene/render_list.h"
#include "gsv/rendering/scene/shadow_region.h"

namespace gsv::rendering {

class ShadowMap {
 public:
  ShadowMap();

  // Draws the shadows of a posed plan for some cameras. `render_list_id` tells plans apart.
  void Draw(const RenderList& render_list, std::uint64_t render_list_id,
            const geometry::Vector3& to_sun, const std::vector<CameraView>& views,
            InstanceBuffer& instances);

  // Makes it current for shaders with SHADOWS.
  void Bind() const;
  const ShadowRegion& region() const { return region_; }

 private:
  struct Drawn {
    std::uint64_t render_list_id = 0;
    int moved_count = -1;
    ShadowRegion region;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  void CopyStill(const ShadowRegion::Rectangle& part);
  void DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& casters,
                   InstanceBuffer& instances);

  GlTexture still_, moving_;
  GlFramebuffer still_frame_, moving_frame_;
  GlProgram solid_, alpha_mask_;
  ShadowRegion region_;
  Drawn drawn_;                                 // what still_ holds
  std::vector<ShadowRegion::Rectangle> moved_;  // where moving_ differs from still_
  std::vector<InstanceData> staged_;
};

}  // namespace gsv::rendering
