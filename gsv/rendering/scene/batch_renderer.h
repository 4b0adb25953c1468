// The interface of back ends. They render batches of images, and cache data between batches.
//
// Threads  the render thread only.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/rendering/lenses/depth_grid.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/scene/draw_copies.h"
#include "gsv/rendering/scene/frame_block.h"
#include "gsv/rendering/scene/render_list.h"

namespace gsv::rendering {

// The interface of a renderer's back end.
class BatchRenderer {
 public:
  virtual ~BatchRenderer() = default;

  // Renders the images; image i shows views[i]. Fails if the back end fails, usually because there
  // is not enough memory.
  virtual base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) = 0;

  // Renders depth and label images; element i is the image of views[i]. Fails if no rasteriser is
  // available.
  virtual base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      const world::Snapshot& snapshot, const std::vector<CameraView>& views) = 0;

  // Renders an image and its depths at every `spacing`-th pixel (at least 1). By default, it renders
  // a depth and label image for this. Fails as Draw() does.
  virtual base::Result<ImageWithDepth> DrawWithDepth(const world::Snapshot& snapshot,
                                                     const CameraView& view, int spacing);

  // Removes data of destroyed layouts, meshes and images.
  virtual void Sweep();
  // Returns the number of cached meshes, textures and layouts.
  DrawCopies Count() const;

 protected:
  // The cached data of one layout.
  struct PlannedLayout {
    std::weak_ptr<const world::Layout> layout;
    std::uint64_t id = 0;  // identifies the render list
    std::unique_ptr<RenderList> render_list;
    std::unique_ptr<Lighting> lighting;
  };

  BatchRenderer(MeshStore meshes, TextureStore textures)
      : meshes_(std::move(meshes)), textures_(std::move(textures)) {}
  // Returns the render list of a layout, and makes it on first use.
  PlannedLayout& RenderListFor(const std::shared_ptr<const world::Layout>& layout);

 private:
  MeshStore meshes_;
  TextureStore textures_;
  std::map<const world::Layout*, PlannedLayout> layouts_;  // by address of the layout
  std::uint64_t next_render_list_id_ = 1;
};

}  // namespace gsv::rendering
