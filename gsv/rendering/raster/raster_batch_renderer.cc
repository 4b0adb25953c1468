#include "gsv/rendering/raster/raster_batch_renderer.h"

#include <algorithm>

#include "gsv/rendering/raster/image_renderer.h"
#include "gsv/rendering/raster/raster_mesh.h"
#include "gsv/rendering/raster/raster_texture.h"

namespace gsv::rendering::raster {
namespace {

constexpr int kMaxTextureSide = 8192;

}  // namespace

bool CanRasterise() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

const char* RasteriserName() {
  return HasSixteenLanes() ? "GSV rasteriser (AVX-512)" : "GSV rasteriser (AVX2)";
}

RasterBatchRenderer::RasterBatchRenderer(int threads, std::unique_ptr<PixelLoops> (*make_loops)())
    : BatchRenderer(MeshStore(MakeRasterMesh), TextureStore(MakeRasterTexture, kMaxTextureSide)),
      make_loops_(make_loops),
      team_(threads) {}

RasterBatchRenderer::~RasterBatchRenderer() = default;

base::Result<std::vector<std::shared_ptr<const model::Image>>> RasterBatchRenderer::Draw(
    const world::Snapshot& snapshot, const std::vector<CameraView>& views) {
  return DrawImages(snapshot, views, 1, nullptr);
}

base::Result<ImageWithDepth> RasterBatchRenderer::DrawWithDepth(const world::Snapshot& snapshot,
                                                                const CameraView& view,
                                                                int spacing) {
  DepthGrid depth;
  auto images = DrawImages(snapshot, {view}, spacing, &depth);
  return ImageWithDepth{std::move(images.front()),
                        std::make_shared<const DepthGrid>(std::move(depth))};
}

std::vector<std::shared_ptr<const model::Image>> RasterBatchRenderer::DrawImages(
    const world::Snapshot& snapshot, const std::vector<CameraView>& views, int spacing,
    DepthGrid* depth) {
  PlannedLayout& planned = RenderListFor(snapshot.layout);
  const RenderList& render_list = *planned.render_list;
  const Lighting& lighting = *planned.lighting;
  planned.render_list->Pose(snapshot);
  planned.lighting->TakeLamps(snapshot);
  const bool shadows = lighting.sun_casts_shadows();
  if (shadows) shadow_.Draw(render_list, planned.id, lighting.to_sun(), views, team_);
  std::vector<std::shared_ptr<const model::Image>> images(views.size());
  const auto draw = [&](ImageRenderer& renderer, std::size_t i, base::ThreadTeam* team) {
    FrameBlock block = lighting.BlockFor(views[i]);
    const bool shaded = shadows && !shadow_.region().IsEmpty();
    if (shaded) shadow_.region().Describe(views[i].world_from_camera.position, block);
    images[i] = std::make_shared<const model::Image>(
        renderer.Draw(views[i], render_list, planned.id, block, shaded ? &shadow_ : nullptr, team));
  };
  if (views.size() == 1) {
    std::unique_ptr<ImageRenderer> renderer = TakeRenderer(views[0]);
    draw(*renderer, 0, &team_);
    if (depth != nullptr) *depth = renderer->SampleDepth(spacing);
    GiveBack(std::move(renderer));
    return images;
  }
  team_.ParallelFor(views.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<ImageRenderer> renderer = TakeRenderer(views[begin]);
    for (std::size_t i = begin; i < end; ++i) draw(*renderer, i, nullptr);
    GiveBack(std::move(renderer));
  });
  return images;
}

base::Result<std::vector<std::shared_ptr<const GroundTruth>>> RasterBatchRenderer::DrawGroundTruth(
    const world::Snapshot& snapshot, const std::vector<CameraView>& views) {
  PlannedLayout& planned = RenderListFor(snapshot.layout);
  planned.render_list->Pose(snapshot, RenderList::Glow::kHidden);
  std::vector<std::shared_ptr<const GroundTruth>> truths(views.size());
  team_.ParallelFor(views.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<ImageRenderer> renderer = TakeRenderer(views[begin]);
    for (std::size_t i = begin; i < end; ++i) {
      truths[i] = std::make_shared<const GroundTruth>(renderer->DrawGroundTruth(
          views[i], *planned.render_list, planned.lighting->BlockFor(views[i])));
    }
    GiveBack(std::move(renderer));
  });
  return truths;
}

std::unique_ptr<ImageRenderer> RasterBatchRenderer::TakeRenderer(const CameraView& view) {
  // A view that no idle renderer has drawn gets a new renderer while fewer than this are idle. So
  // at least this many renderers keep the still parts of their views for the next image.
  constexpr std::size_t kMinKept = 4;
  const base::MutexLock lock(mutex_);
  auto found = std::find_if(idle_.begin(), idle_.end(),
                            [&](const auto& renderer) { return renderer->IsOf(view); });
  if (found == idle_.end()) {
    if (idle_.size() < kMinKept) return std::make_unique<ImageRenderer>(make_loops_);
    // The renderer that was used last, because its memory is in the cache.
    found = std::prev(idle_.end());
  }
  auto renderer = std::move(*found);
  idle_.erase(found);
  return renderer;
}

void RasterBatchRenderer::GiveBack(std::unique_ptr<ImageRenderer> renderer) {
  // A renderer of an image with more pixels than this is deleted at once, to free its memory.
  constexpr std::size_t kMaxPixels = 2 << 20;
  if (renderer->pixels() > kMaxPixels) return;
  const base::MutexLock lock(mutex_);
  idle_.push_back(std::move(renderer));
}

}  // namespace gsv::rendering::raster
