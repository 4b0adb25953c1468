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
  // `block` must include the shadow parameters. If `shadows` is null, there are no shadows.
  void Draw(const CameraView& view, const RenderList& render_list, const FrameBlock& block,
            const ShadowMap* shadows, InstanceBuffer& instances);

 private:
  // The instances that one draw call draws.
  struct Call {
    int group = 0;  // index in RenderList::groups()
    // Distance of the camera from the nearest item of the call, for the order of drawing.
    double distance = 0;
    std::size_t first = 0, count = 0;  // range of the instances in staged_
    bool shadowed = false;             // whether some of the instances may be in shadow
  };
  // An item that the camera may see.
  struct Seen {
    int group = 0;          // index in RenderList::groups()
    double distance = 0;    // distance of the camera from the centre of the item
    std::size_t item = 0;   // index in RenderList::items()
    bool shadowed = false;  // whether the item may be in shadow
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
  GlProgram sky_;                           // the program that draws the sky
  GlBuffer frame_;                          // the FrameBlock of the current image
  std::vector<Seen> solid_, transparent_;   // visible items, opaque and transparent
  std::vector<Call> solid_calls_, transparent_calls_;  // the staged draw calls
  std::vector<InstanceData> staged_;                   // the instances of all draw calls
};

}  // namespace gsv::rendering
