#include "gsv/rendering/scene/batch_renderer.h"

namespace gsv::rendering {

base::Result<ImageWithDepth> BatchRenderer::DrawWithDepth(const world::Snapshot& snapshot,
                                                          const CameraView& view, int spacing) {
  auto images = Draw(snapshot, {view});
  if (!images) return base::Fail(images.error());
  ImageWithDepth drawn{std::move(images->front()), nullptr};
  const auto truths = DrawGroundTruth(snapshot, {view});
  if (!truths) return drawn;
  const GroundTruth& truth = *truths->front();
  drawn.depth = std::make_shared<const DepthGrid>(
      MakeDepthGrid(truth.width, truth.height, spacing, [&](int x, int y) {
        return 1 / truth.depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) +
                               static_cast<std::size_t>(x)];
      }));
  return drawn;
}

BatchRenderer::PlannedLayout& BatchRenderer::RenderListFor(
    const std::shared_ptr<const world::Layout>& layout) {
  PlannedLayout& planned = layouts_[layout.get()];
  // To compare addresses is not sufficient: a destroyed layout may have had the same address.
  if (planned.render_list == nullptr || planned.layout.lock() != layout) {
    planned = {layout, next_render_list_id_++,
               std::make_unique<RenderList>(*layout, meshes_, textures_),
               std::make_unique<Lighting>(*layout->description)};
  }
  return planned;
}

void BatchRenderer::Sweep() {
  std::erase_if(layouts_, [](const auto& item) { return item.second.layout.expired(); });
  meshes_.Sweep();
  textures_.Sweep();
}

DrawCopies BatchRenderer::Count() const {
  return {meshes_.size(), textures_.size(), layouts_.size()};
}

}  // namespace gsv::rendering
