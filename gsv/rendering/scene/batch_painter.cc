#include "gsv/rendering/scene/batch_painter.h"

namespace gsv::rendering {

BatchPainter::PlannedLayout& BatchPainter::PlanFor(
    const std::shared_ptr<const world::Layout>& layout) {
  PlannedLayout& planned = layouts_[layout.get()];
  // An address may be that of an earlier layout that is gone.
  if (planned.plan == nullptr || planned.layout.lock() != layout) {
    planned = {layout, next_plan_id_++, std::make_unique<DrawPlan>(*layout, meshes_, textures_),
               std::make_unique<Lighting>(*layout->description)};
  }
  return planned;
}

void BatchPainter::Sweep() {
  std::erase_if(layouts_, [](const auto& item) { return item.second.layout.expired(); });
  meshes_.Sweep();
  textures_.Sweep();
}

DrawCopies BatchPainter::Count() const {
  return {meshes_.size(), textures_.size(), layouts_.size()};
}

}  // namespace gsv::rendering
