// Renders images with OpenGL, and owns all objects on the graphics card.
//
// Threads  the render thread only, with the context current from construction to destruction.
#pragma once

#include <list>
#include <memory>
#include <vector>

#include "gsv/rendering/opengl/render_target.h"
#include "gsv/rendering/opengl/shadow_map.h"
#include "gsv/rendering/opengl/view_pass.h"
#include "gsv/rendering/scene/batch_renderer.h"

namespace gsv::rendering {

namespace raster {
class RasterBatchRenderer;
}

// The back end that renders with OpenGL.
class GlBatchRenderer final : public BatchRenderer {
 public:
  GlBatchRenderer();
  ~GlBatchRenderer() override;

  base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  // Renders on the CPU (raster/), so that results are bit-identical on every machine.
  base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  // Frees the meshes and textures that are not in use.
  void Sweep() override;

 private:
  // Returns a render target of the camera's image size.
  RenderTarget& TargetFor(const CameraParameters& camera);

  std::list<RenderTarget> targets_;  // ordered by last use, the most recent first
  InstanceBuffer instances_;
  ShadowMap shadow_map_;
  ViewPass view_pass_;
  std::unique_ptr<raster::RasterBatchRenderer> ground_truth_renderer_;  // null until the first use
};

}  // namespace gsv::rendering
