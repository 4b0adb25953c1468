// How a batch of pictures is drawn, and what is kept for the next: one kind for each back end.
//
// Threads  the render thread only.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/scene/draw_copies.h"
#include "gsv/rendering/scene/frame_block.h"
#include "gsv/rendering/scene/render_list.h"

namespace gsv::rendering {

class BatchRenderer {
 public:
  virtual ~BatchRenderer() = default;

  // pictures[i] is views[i]'s. Fails when the back end does, which is most often out of memory.
  virtual base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) = 0;

  // truths[i] is views[i]'s. Fails where nothing can draw them.
  virtual base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) = 0;

  // Forgets what belongs to layouts, meshes and pictures that are gone.
  virtual void Sweep();
  DrawCopies Count() const;

 protected:
  struct PlannedLayout {
    std::weak_ptr<const world::Layout> layout;
    std::uint64_t id = 0;  // tells plans apart
    std::unique_ptr<RenderList> render_list;
    std::unique_ptr<Lighting> lighting;
  };

  BatchRenderer(MeshStore meshes, TextureStore textures)
      : meshes_(std::move(meshes)), textures_(std::move(textures)) {}
  PlannedLayout& RenderListFor(const std::shared_ptr<const world::Layout>& layout);

 private:
  MeshStore meshes_;
  TextureStore textures_;
  std::map<const world::Layout*, PlannedLayout> layouts_;
  std::uint64_t next_render_list_id_ = 1;
};

}  // namespace gsv::rendering
