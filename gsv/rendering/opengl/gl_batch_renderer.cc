#include "gsv/rendering/opengl/gl_batch_renderer.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "gsv/rendering/opengl/gl.h"
#include "gsv/rendering/opengl/gpu_mesh.h"
#include "gsv/rendering/opengl/gpu_texture.h"
#include "gsv/rendering/raster/raster_batch_renderer.h"

namespace gsv::rendering {
namespace {

using Images = std::vector<std::shared_ptr<const model::Image>>;

base::Status CheckCard() {
  const unsigned error = glGetError();
  if (error == GL_NO_ERROR) return {};
  while (glGetError() != GL_NO_ERROR) {
  }
  if (error == GL_OUT_OF_MEMORY) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "the graphics card has too little memory for this world and image size");
  }
  char code[16];
  std::snprintf(code, sizeof code, "0x%04x", error);
  return base::Fail(base::ErrorCode::kUnavailable,
                    std::string("OpenGL failed with ") + code + " while an image was drawn");
}

}  // namespace

GlBatchRenderer::~GlBatchRenderer() = default;

GlBatchRenderer::GlBatchRenderer()
    : BatchRenderer(MeshStore(UploadMesh), TextureStore(UploadTexture, MaxTextureSide())) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_DITHER);
}

RenderTarget& GlBatchRenderer::TargetFor(const CameraParameters& camera) {
  constexpr std::size_t kMaxTargets = 4;
  const auto found = std::find_if(targets_.begin(), targets_.end(), [&](const RenderTarget& t) {
    return t.width() == camera.width && t.height() == camera.height;
  });
  if (found != targets_.end()) {
    targets_.splice(targets_.begin(), targets_, found);
  } else {
    if (targets_.size() == kMaxTargets) targets_.pop_back();
    targets_.emplace_front(camera.width, camera.height);
  }
  return targets_.front();
}

base::Result<Images> GlBatchRenderer::Draw(const world::Snapshot& snapshot,
                                           const std::vector<CameraView>& views) {
  PlannedLayout& planned = RenderListFor(snapshot.layout);
  const RenderList& render_list = *planned.render_list;
  const Lighting& lighting = *planned.lighting;
  planned.render_list->Pose(snapshot);
  planned.lighting->TakeLamps(snapshot);
  const bool shadows = lighting.sun_casts_shadows();
  if (shadows) {
    shadow_map_.Draw(render_list, planned.id, lighting.to_sun(), views, instances_);
    shadow_map_.Bind();
  }
  // Images of equal size are rendered one after another and read back together.
  std::vector<std::size_t> order(views.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto size = [&](std::size_t i) {
    return std::pair(views[i].parameters.width, views[i].parameters.height);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) < size(b); });

  Images images(views.size());
  for (std::size_t done = 0; done < order.size();) {
    RenderTarget& target = TargetFor(views[order[done]].parameters);
    std::size_t end = done;
    while (end < order.size() && end - done < static_cast<std::size_t>(target.capacity()) &&
           size(order[end]) == size(order[done])) {
      const CameraView& view = views[order[end++]];
      FrameBlock block = lighting.BlockFor(view);
      if (shadows) shadow_map_.region().Describe(view.world_from_camera.position, block);
      target.Begin();
      view_pass_.Draw(view, render_list, block, shadows ? &shadow_map_ : nullptr, instances_);
    }
    for (auto& image : target.Read()) images[order[done++]] = std::move(image);
  }
  if (base::Status status = CheckCard(); !status) return base::Fail(status.error());
  return images;
}

base::Result<std::vector<std::shared_ptr<const GroundTruth>>> GlBatchRenderer::DrawGroundTruth(
    const world::Snapshot& snapshot, const std::vector<CameraView>& views) {
  if (!raster::CanRasterise()) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "depth, thermal, segmentation, bounding-box and normals cameras need AVX2 "
                      "and FMA, and this processor lacks one of them");
  }
  if (ground_truth_renderer_ == nullptr) {
    ground_truth_renderer_ =
        std::make_unique<raster::RasterBatchRenderer>(base::ThreadTeam::DefaultThreads());
  }
  return ground_truth_renderer_->DrawGroundTruth(snapshot, views);
}

void GlBatchRenderer::Sweep() {
  BatchRenderer::Sweep();
  if (ground_truth_renderer_ != nullptr) ground_truth_renderer_->Sweep();
}

}  // namespace gsv::rendering
