// The shadow map of the sun: one per snapshot, for all cameras.
//
// Static shadow casters are drawn once, into a first map. A second map also contains the moving
// casters. For each snapshot, the changed parts of the second map are copied from the first map,
// and those moving casters are drawn again whose shadows a camera may see.
// Threads  the render thread only.
#pragma once

#include "gsv/rendering/opengl/instance_buffer.h"
#include "gsv/rendering/scene/render_list.h"
#include "gsv/rendering/scene/shadow_region.h"

namespace gsv::rendering {

// The shadow map of the sun on the graphics card.
class ShadowMap {
 public:
  ShadowMap();

  // Draws the shadow map of a posed render list for some cameras. `render_list_id` identifies the
  // render list.
  void Draw(const RenderList& render_list, std::uint64_t render_list_id,
            const geometry::Vector3& to_sun, const std::vector<CameraView>& views,
            InstanceBuffer& instances);

  // Binds the shadow map for shaders with SHADOWS defined.
  void Bind() const;
  const ShadowRegion& region() const { return region_; }

 private:
  // Identifies the content of a map: its render list, its number of moved bodies, and its region.
  struct Drawn {
    std::uint64_t render_list_id = 0;
    int moved_count = -1;  // RenderList::moved_count(); -1: nothing was drawn
    ShadowRegion region;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  // Copies a part of still_, the map of static casters, to moving_.
  void CopyStill(const ShadowRegion::Rectangle& part);
  // Draws shadow casters into the map that is bound.
  void DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& casters,
                   InstanceBuffer& instances);

  // The map of static casters, and the map of all casters.
  GlTexture still_, moving_;
  GlFramebuffer still_frame_, moving_frame_;
  GlProgram solid_, alpha_mask_;  // for opaque casters, and for casters with holes
  ShadowRegion region_;
  Drawn drawn_;                                 // the content of still_ (static casters)
  std::vector<ShadowRegion::Rectangle> moved_;  // the parts in which moving_ differs from still_
  std::vector<InstanceData> staged_;  // working memory: the instances of the next draw calls
};

}  // namespace gsv::rendering
