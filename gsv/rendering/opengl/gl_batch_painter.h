// Pictures with OpenGL: everything that lives on the graphics card.
//
// Threads  the render thread only, with the context current from construction to destruction.
#pragma once

#include <list>
#include <memory>
#include <vector>

#include "gsv/rendering/opengl/picture_target.h"
#include "gsv/rendering/opengl/shadow_map.h"
#include "gsv/rendering/opengl/view_painter.h"
#include "gsv/rendering/scene/batch_painter.h"

namespace gsv::rendering {

namespace raster {
class RasterBatchPainter;
}

class GlBatchPainter final : public BatchPainter {
 public:
  GlBatchPainter();
  ~GlBatchPainter() override;

  base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  // By the rasteriser: ground truth is the same to the bit on every machine.
  base::Result<std::vector<std::shared_ptr<const GroundTruth>>> Survey(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  void Sweep() override;

 private:
  PictureTarget& TargetFor(const CameraParameters& camera);

  std::list<PictureTarget> targets_;  // most recently used first
  InstanceBuffer instances_;
  ShadowMap shadow_map_;
  ViewPainter painter_;
  std::unique_ptr<raster::RasterBatchPainter> surveyor_;  // null until it is asked for
};

}  // namespace gsv::rendering
