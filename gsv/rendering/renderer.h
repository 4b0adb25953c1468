// Renders images of snapshots on its own thread: with OpenGL on a graphics card, otherwise with the
// built-in rasteriser.
//
// Pending requests for one snapshot are rendered as one batch, with one shadow map. The back
// end keeps each mesh and texture once, for all snapshots and simulations. It frees them after
// their model is destroyed.
//
// Determinism  an image is a function of snapshot, camera and renderer_name(). Equal inputs give
//              equal bytes on one renderer, in any batch.
// Errors       Start(): kUnavailable, with the name of the missing part. Draw(): kInvalidArgument
//              for an invalid camera, kTimeout, kUnavailable if too many requests are pending or
//              the card fails, kEnded while the renderer shuts down.
// Threads      any; Draw() blocks its caller.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"
#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/rendering/lenses/depth_grid.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/opengl/egl_context.h"
#include "gsv/rendering/scene/draw_copies.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

// The implementation that renders the images.
enum class BackEnd {
  // OpenGL on a graphics card. If there is none, the rasteriser; on processors without AVX2 and
  // FMA, Mesa's software renderer.
  kAutomatic,
  kOpenGl,      // OpenGL, on the devices that `egl` allows
  kRasteriser,  // the rasteriser; kUnavailable on processors without AVX2 and FMA
};

// The settings of a renderer.
struct RendererOptions {
  BackEnd back_end = BackEnd::kAutomatic;
  EglOptions egl;
  // The maximum number of pending requests; further requests are refused.
  std::size_t queue_capacity = 4096;
};

// Renders images of snapshots on its own thread.
class Renderer {
 public:
  // The default limit of the time that a call waits. It is longer than the time that the slowest
  // machine needs for an image. A behaviour that waits for an image may exceed the simulation's
  // deadline for behaviours earlier.
  static constexpr std::chrono::seconds kTimeout{60};

  // Starts the render thread. Returns kUnavailable if the back end cannot be used on this machine.
  [[nodiscard]] static base::Result<std::shared_ptr<Renderer>> Start(RendererOptions options = {});
  // Ends all pending requests with kEnded.
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Renders an RGB image of `snapshot`.
  [[nodiscard]] base::Result<std::shared_ptr<const model::Image>> Draw(
      std::shared_ptr<const world::Snapshot> snapshot, const CameraView& view,
      std::chrono::milliseconds timeout = kTimeout);

  // Renders several cameras in one batch. Image i is the image of views[i].
  [[nodiscard]] base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      std::shared_ptr<const world::Snapshot> snapshot, const std::vector<CameraView>& views,
      std::chrono::milliseconds timeout = kTimeout);

  // Renders an RGB image, and its depths at every `spacing`-th pixel (at least 1).
  [[nodiscard]] base::Result<ImageWithDepth> DrawWithDepth(
      std::shared_ptr<const world::Snapshot> snapshot, const CameraView& view, int spacing,
      std::chrono::milliseconds timeout = kTimeout);

  // Renders depth and label images. Element i is the image of views[i]. This function always uses
  // the rasteriser. It returns kUnavailable on processors without AVX2 and FMA.
  [[nodiscard]] base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      std::shared_ptr<const world::Snapshot> snapshot, const std::vector<CameraView>& views,
      std::chrono::milliseconds timeout = kTimeout);

  // For example "GSV rasteriser (AVX2)" or "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core
  // Profile) Mesa 22.3.6".
  const std::string& renderer_name() const { return renderer_name_; }

  // Frees the back end's meshes and textures that are not in use. Returns the number of the
  // remaining meshes and textures. Waits for the batch in progress.
  DrawCopies CountCopies();

 private:
  class RenderThread;
  Renderer();

  std::unique_ptr<RenderThread> thread_;  // the thread that draws all images
  std::string renderer_name_;
};

}  // namespace gsv::rendering
