#include "gsv/rendering/raster/raster_batch_painter.h"

#include "gsv/rendering/raster/picture_painter.h"
#include "gsv/rendering/raster/raster_mesh.h"
#include "gsv/rendering/raster/raster_texture.h"

namespace gsv::rendering::raster {
namespace {

constexpr int kLargestTexture = 8192;

}  // namespace

bool CanRasterise() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

RasterBatchPainter::RasterBatchPainter(int threads)
    : BatchPainter(MeshStore(MakeRasterMesh), TextureStore(MakeRasterTexture, kLargestTexture)),
      team_(threads) {}

RasterBatchPainter::~RasterBatchPainter() = default;

base::Result<std::vector<std::shared_ptr<const model::Image>>> RasterBatchPainter::Draw(
    const world::Snapshot& snapshot, const std::vector<CameraView>& views) {
  PlannedLayout& planned = PlanFor(snapshot.layout);
  const DrawPlan& plan = *planned.plan;
  const Lighting& lighting = *planned.lighting;
  planned.plan->Pose(snapshot);
  planned.lighting->TakeLamps(snapshot);
  const bool shadows = lighting.sun_casts_shadows();
  if (shadows) shadow_.Draw(plan, planned.id, lighting.to_sun(), views);
  std::vector<std::shared_ptr<const model::Image>> pictures(views.size());
  team_.Share(views.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<PicturePainter> painter = TakePainter();
    for (std::size_t i = begin; i < end; ++i) {
      FrameBlock block = lighting.BlockFor(views[i]);
      const bool shaded = shadows && !shadow_.region().IsEmpty();
      if (shaded) shadow_.region().Describe(views[i].world_from_camera.position, block);
      pictures[i] = std::make_shared<const model::Image>(
          painter->Paint(views[i], plan, block, shaded ? &shadow_ : nullptr));
    }
    GiveBack(std::move(painter));
  });
  return pictures;
}

base::Result<std::vector<std::shared_ptr<const GroundTruth>>> RasterBatchPainter::Survey(
    const world::Snapshot& snapshot, const std::vector<CameraView>& views) {
  PlannedLayout& planned = PlanFor(snapshot.layout);
  planned.plan->Pose(snapshot, DrawPlan::Glow::kHidden);
  std::vector<std::shared_ptr<const GroundTruth>> truths(views.size());
  team_.Share(views.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<PicturePainter> painter = TakePainter();
    for (std::size_t i = begin; i < end; ++i) {
      truths[i] = std::make_shared<const GroundTruth>(
          painter->Survey(views[i], *planned.plan, planned.lighting->BlockFor(views[i])));
    }
    GiveBack(std::move(painter));
  });
  return truths;
}

std::unique_ptr<PicturePainter> RasterBatchPainter::TakePainter() {
  const base::MutexLock lock(mutex_);
  if (idle_.empty()) return std::make_unique<PicturePainter>();
  auto painter = std::move(idle_.back());
  idle_.pop_back();
  return painter;
}

void RasterBatchPainter::GiveBack(std::unique_ptr<PicturePainter> painter) {
  // What a picture as large as a wall took is not kept for the next small one.
  constexpr std::size_t kMostPixels = 2 << 20;
  if (painter->pixels() > kMostPixels) return;
  const base::MutexLock lock(mutex_);
  idle_.push_back(std::move(painter));
}

}  // namespace gsv::rendering::raster
