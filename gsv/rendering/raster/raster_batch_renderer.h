// Pictures drawn by the processor, on several threads: what a machine without a graphics card has
// them from.
//
// Determinism  a picture is the same to the bit on every machine, whatever the batch and the number
//              of threads.
// Threads      one thread at a time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/thread_team.h"
#include "gsv/rendering/raster/sun_shadow.h"
#include "gsv/rendering/scene/batch_renderer.h"

namespace gsv::rendering::raster {

class ImageRenderer;

inline constexpr const char* kRasteriserName = "GSV rasteriser (AVX2)";

// Whether this processor has what the rasteriser is made of: AVX2 and FMA.
bool CanRasterise();

class RasterBatchRenderer final : public BatchRenderer {
 public:
  // `threads` >= 1.
  explicit RasterBatchRenderer(int threads);
  ~RasterBatchRenderer() override;

  base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;

 private:
  std::unique_ptr<ImageRenderer> TakeRenderer();
  void GiveBack(std::unique_ptr<ImageRenderer> painter);

  base::ThreadTeam team_;
  SunShadow shadow_;
  base::Mutex mutex_;
  std::vector<std::unique_ptr<ImageRenderer>> idle_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::rendering::raster
