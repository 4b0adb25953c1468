// Takes pictures of snapshots, on a thread of its own: with OpenGL on a graphics card, without one
// by a rasteriser of our own.
//
// All requests that wait for the same snapshot are drawn as one batch, with one shadow map. The
// copies of meshes and textures are shared between snapshots and simulations, and freed after the
// model they came from is gone.
//
// Determinism  a picture is a function of snapshot, camera and renderer_name(): equal inputs give
//              equal bytes on one renderer, whatever else is drawn in the same batch.
// Errors       Start(): kUnavailable with what is missing. Draw(): kInvalidArgument for a camera
//              that cannot be, kTimeout, kUnavailable when too many wait or the card fails,
//              kEnded while the renderer shuts down.
// Threads      any; Draw() blocks its caller.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/image.h"
#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/opengl/egl_context.h"
#include "gsv/rendering/scene/draw_copies.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

enum class BackEnd {
  kAutomatic,   // a graphics card; without one the rasteriser, or Mesa on processors without AVX2
  kOpenGl,      // as `egl` allows
  kRasteriser,  // kUnavailable on processors without AVX2 and FMA
};

struct RendererOptions {
  BackEnd back_end = BackEnd::kAutomatic;
  EglOptions egl;
  // Requests that may wait at one moment; more are refused.
  std::size_t queue_capacity = 4096;
};

class Renderer {
 public:
  // No machine takes as long for a picture, however slow and busy; what gives up sooner on a
  // behaviour is the simulation's deadline.
  static constexpr std::chrono::seconds kPatience{60};

  [[nodiscard]] static base::Result<std::shared_ptr<Renderer>> Start(RendererOptions options = {});
  // Ends what waits with kEnded.
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // An RGB picture of `snapshot`.
  [[nodiscard]] base::Result<std::shared_ptr<const model::Image>> Draw(
      std::shared_ptr<const world::Snapshot> snapshot, const CameraView& view,
      std::chrono::milliseconds timeout = kPatience);

  // The same for several cameras; pictures[i] is views[i]'s. They are drawn in one batch.
  [[nodiscard]] base::Result<std::vector<std::shared_ptr<const model::Image>>> Draw(
      std::shared_ptr<const world::Snapshot> snapshot, const std::vector<CameraView>& views,
      std::chrono::milliseconds timeout = kPatience);

  // Distances and whose they are, truths[i] being views[i]'s; always by the rasteriser:
  // kUnavailable on processors without AVX2 and FMA.
  [[nodiscard]] base::Result<std::vector<std::shared_ptr<const GroundTruth>>> DrawGroundTruth(
      std::shared_ptr<const world::Snapshot> snapshot, const std::vector<CameraView>& views,
      std::chrono::milliseconds timeout = kPatience);

  // "GSV rasteriser (AVX2)" or "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa
  // 22.3.6".
  const std::string& renderer_name() const { return renderer_name_; }

  // After what nobody uses any more has been freed. Waits for the batch in progress.
  DrawCopies CountCopies();

 private:
  class RenderThread;
  Renderer();

  std::unique_ptr<RenderThread> thread_;
  std::string renderer_name_;
};

}  // namespace gsv::rendering
