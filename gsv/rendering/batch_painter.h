// Everything that lives on the graphics card, and how a batch of pictures is drawn with it.
//
// Threads  the render thread only, with the context current from construction to destruction.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/rendering/picture_target.h"
#include "gsv/rendering/renderer.h"
#include "gsv/rendering/shadow_map.h"
#include "gsv/rendering/view_painter.h"

namespace gsv::rendering {

class BatchPainter {
 public:
  BatchPainter();

  // pictures[i] is views[i]'s. Fails when the card does, which is most often out of memory.
  base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views);

  // Forgets what belongs to layouts, meshes and pictures that are gone.
  void Sweep();
  GpuCopies Count() const;

 private:
  struct PlannedLayout {
    std::weak_ptr<const world::Layout> layout;
    std::uint64_t id = 0;
    std::unique_ptr<DrawPlan> plan;
    std::unique_ptr<Lighting> lighting;
  };

  PlannedLayout& PlanFor(const std::shared_ptr<const world::Layout>& layout);
  PictureTarget& TargetFor(const CameraParameters& camera);

  GpuMeshes meshes_;
  GpuTextures textures_;
  std::map<const world::Layout*, PlannedLayout> layouts_;
  std::uint64_t next_plan_id_ = 1;
  std::list<PictureTarget> targets_;  // most recently used first
  InstanceBuffer instances_;
  ShadowMap shadow_map_;
  ViewPainter painter_;
};

}  // namespace gsv::rendering
