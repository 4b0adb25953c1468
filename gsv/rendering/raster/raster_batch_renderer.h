// Renders images on the processor with several threads, for machines without a graphics card.
//
// Determinism  images are bit-identical on every machine, for any batch and number of threads.
// Threads      one thread at a time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/thread_team.h"
#include "gsv/rendering/raster/pixel_loops.h"
#include "gsv/rendering/raster/sun_shadow.h"
#include "gsv/rendering/scene/batch_renderer.h"

namespace gsv::rendering::raster {

class ImageRenderer;

// Returns the name of the back end, such as "GSV rasteriser (AVX-512)".
const char* RasteriserName();

// Whether this processor has AVX2 and FMA, which the rasteriser needs.
bool CanRasterise();

// The back end that renders on the processor.
class RasterBatchRenderer final : public BatchRenderer {
 public:
  // `threads` is at least 1. `make_loops` makes the loops over pixels; all loops give the same images.
  explicit RasterBatchRenderer(int threads,
                               std::unique_ptr<PixelLoops> (*make_loops)() = MakePixelLoops);
  ~RasterBatchRenderer() override;

  base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) override;
  // The depths are those of the rendered image, so they cost almost nothing.
  base::Result<ImageWithDepth> DrawWithDepth(const world::Snapshot& snapshot,
                                             const CameraView& view, int spacing) override;

 private:
  // Renders the images. If `depth` is not null, also stores the depths of the only view.
  std::vector<std::shared_ptr<const model::Image>> DrawImages(const world::Snapshot& snapshot,
                                                              const std::vector<CameraView>& views,
                                                              int spacing, DepthGrid* depth);
  // Returns an idle renderer, preferably the one whose last image had this view.
  std::unique_ptr<ImageRenderer> TakeRenderer(const CameraView& view);
  // Makes a renderer idle again.
  void GiveBack(std::unique_ptr<ImageRenderer> renderer);

  std::unique_ptr<PixelLoops> (*const make_loops_)();
  base::ThreadTeam team_;
  SunShadow shadow_;
  base::Mutex mutex_;
  std::vector<std::unique_ptr<ImageRenderer>> idle_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::rendering::raster
