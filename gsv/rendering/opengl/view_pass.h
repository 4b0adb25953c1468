// Renders the view of one camera.
//
// The pass draws opaque groups first, from near to far; the ground is the last of them. Then it
// draws the sky, and then transparent groups from far to near.
// Threads  the render thread only.
#pragma once

#include <map>
#include <vector>

#include "gsv/rendering/opengl/instance_buffer.h"
#include "gsv/rendering/opengl/shadow_map.h"
#include "gsv/rendering/scene/frame_block.h"

namespace gsv::rendering {

// Renders the image of one camera with OpenGL.
class ViewPass {
 public:
  ViewPass();

  // Draws a posed render list into the current target. The depth of the target must be cleared.
  // `block` must be complete. If `shadows` is null, there are no shadows.
  void Draw(const CameraView& view, const RenderList& render_list, const FrameBlock& block,
            const ShadowMap* shadows, InstanceBuffer& instances);

 private:
  // The instances that one draw call draws.
  struct Call {
    int group = 0;
    double distance = 0;
    std::size_t first = 0, count = 0;
    bool shadowed = false;  // whether some of the instances may be in shadow
  };
  struct Seen {
    int group = 0;
    double distance = 0;  // distance of the camera from the centre of the item
    std::size_t item = 0;
    bool shadowed = false;
  };

  // Lists the items that the camera may see.
  void FindVisible(const CameraView& view, const RenderList& render_list, const ShadowMap* shadows);
  // Makes the draw calls of opaque items: one for each group.
  void StageSolid(const RenderList& render_list, const geometry::Vector3& origin);
  // Makes the draw calls of transparent items, from far to near.
  void StageTransparent(const RenderList& render_list, const geometry::Vector3& origin);
  // Makes the staged draw calls.
  void Draw(const std::vector<Call>& calls, const RenderList& render_list, bool lamps,
            const InstanceBuffer& instances);
  // Returns the shader program with these features, and compiles it on first use.
  unsigned ProgramFor(unsigned features);

  std::map<unsigned, GlProgram> programs_;  // programs by the features that they were compiled with
  GlProgram sky_;
  GlBuffer frame_;
  std::vector<Seen> solid_, transparent_;
  std::vector<Call> solid_calls_, transparent_calls_;
  std::vector<InstanceData> staged_;
};

}  // namespace gsv::rendering
