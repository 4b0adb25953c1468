#include "gsv/rendering/renderer.h"

#include <pthread.h>

#include <algorithm>
#include <deque>
#include <future>
#include <span>
#include <thread>

#include "gsv/base/check.h"
#include "gsv/base/mutex.h"
#include "gsv/rendering/opengl/gl_batch_renderer.h"
#include "gsv/rendering/raster/raster_batch_renderer.h"

namespace gsv::rendering {
namespace {

using base::ErrorCode;
using base::Fail;
using base::Result;
using Images = std::vector<std::shared_ptr<const model::Image>>;

// The maximum number of images in a batch, so that requests for other snapshots do not wait too
// long.
constexpr std::size_t kMaxBatchSize = 64;
// If there are no requests for this time, unused data are removed from the card.
constexpr std::chrono::seconds kIdleSweep{5};

using Truths = std::vector<std::shared_ptr<const GroundTruth>>;

struct Request {
  std::shared_ptr<const world::Snapshot> snapshot;
  std::vector<CameraView> views;
  bool is_survey = false;  // whether depth and label images (`truths`) are requested, instead of
                           // `images`
  int depth_spacing = 0;   // not 0: an image with its depths is requested, with this spacing
  std::promise<Result<Images>> images;
  std::promise<Result<Truths>> truths;
  std::promise<Result<ImageWithDepth>> with_depth;
  bool abandoned = false;  // the caller no longer waits

  void Fail(const base::Error& error) {
    if (depth_spacing > 0) {
      with_depth.set_value(base::Fail(error));
    } else if (is_survey) {
      truths.set_value(base::Fail(error));
    } else {
      images.set_value(base::Fail(error));
    }
  }
};

}  // namespace

class Renderer::RenderThread {
 public:
  explicit RenderThread(RendererOptions options) : options_(std::move(options)) {}

  ~RenderThread() {
    {
      const base::MutexLock lock(mutex_);
      stopping_ = true;
    }
    work_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  // Starts the back end and returns the renderer's name.
  Result<std::string> Start() {
    std::promise<Result<std::string>> started;
    std::future<Result<std::string>> name = started.get_future();
    thread_ = std::thread([this, promise = std::move(started)]() mutable { Run(promise); });
    return name.get();
  }

  Result<Images> Draw(std::shared_ptr<const world::Snapshot> snapshot,
                      std::vector<CameraView> views, std::chrono::milliseconds timeout) {
    auto request = std::make_shared<Request>();
    request->snapshot = std::move(snapshot);
    request->views = std::move(views);
    return Await(request, request->images.get_future(), timeout);
  }

  Result<ImageWithDepth> DrawWithDepth(std::shared_ptr<const world::Snapshot> snapshot,
                                       const CameraView& view, int spacing,
                                       std::chrono::milliseconds timeout) {
    auto request = std::make_shared<Request>();
    request->snapshot = std::move(snapshot);
    request->views = {view};
    request->depth_spacing = spacing;
    return Await(request, request->with_depth.get_future(), timeout);
  }

  Result<Truths> DrawGroundTruth(std::shared_ptr<const world::Snapshot> snapshot,
                                 std::vector<CameraView> views, std::chrono::milliseconds timeout) {
    auto request = std::make_shared<Request>();
    request->snapshot = std::move(snapshot);
    request->views = std::move(views);
    request->is_survey = true;
    return Await(request, request->truths.get_future(), timeout);
  }

  DrawCopies Count() {
    std::future<DrawCopies> count;
    {
      const base::MutexLock lock(mutex_);
      count = counts_.emplace_back().get_future();
    }
    work_.notify_one();
    return count.get();
  }

 private:
  using Batch = std::vector<std::shared_ptr<Request>>;

  template <typename Product>
  Result<Product> Await(const std::shared_ptr<Request>& request,
                        std::future<Result<Product>> product, std::chrono::milliseconds timeout) {
    {
      const base::MutexLock lock(mutex_);
      if (queue_.size() >= options_.queue_capacity) {
        return Fail(
            ErrorCode::kUnavailable,
            std::to_string(queue_.size()) +
                " requests for images are already waiting; ask less often or for smaller ones");
      }
      queue_.push_back(request);
    }
    work_.notify_one();
    if (product.wait_for(timeout) == std::future_status::ready) return product.get();
    const base::MutexLock lock(mutex_);
    request->abandoned = true;
    return Fail(ErrorCode::kTimeout,
                "no image within " + std::to_string(timeout.count()) +
                    " ms; the renderer is overloaded: ask less often or for smaller images");
  }

  void Run(std::promise<Result<std::string>>& started) {
    pthread_setname_np(pthread_self(), "drawing");  // the threads of the rasteriser inherit this
                                                    // name
    const bool automatic = options_.back_end == BackEnd::kAutomatic;
    EglOptions egl = options_.egl;
    if (automatic && raster::CanRasterise()) egl.software = false;
    std::unique_ptr<EglContext> context;
    std::unique_ptr<BatchRenderer> renderer;
    if (options_.back_end != BackEnd::kRasteriser) {
      Result<std::unique_ptr<EglContext>> created = EglContext::Create(egl);
      if (!created && !(automatic && raster::CanRasterise())) {
        started.set_value(Fail(created.error()));
        return;
      }
      if (created) {
        context = *std::move(created);
        renderer = std::make_unique<GlBatchRenderer>();
      }
    } else if (!raster::CanRasterise()) {
      started.set_value(Fail(ErrorCode::kUnavailable,
                             "this processor lacks AVX2 or FMA, which the rasteriser requires; "
                             "images need OpenGL here"));
      return;
    }
    if (renderer == nullptr) {
      renderer = std::make_unique<raster::RasterBatchRenderer>(base::ThreadTeam::DefaultThreads());
    }
    started.set_value(context != nullptr ? context->renderer_name() : raster::RasteriserName());
    Serve(*renderer);
    renderer.reset();
    EndAll();
  }

  void Serve(BatchRenderer& renderer) {
    base::MutexLock lock(mutex_);
    while (!stopping_) {
      Batch batch = TakeBatch();
      std::vector<std::promise<DrawCopies>> counts = std::exchange(counts_, {});
      if (batch.empty() && counts.empty()) {
        const bool woken = work_.wait_for(lock, kIdleSweep, [&]() GSV_REQUIRES(mutex_) {
          return stopping_ || !queue_.empty() || !counts_.empty();
        });
        if (!woken) renderer.Sweep();
        continue;
      }
      lock.unlock();
      if (!batch.empty()) Serve(renderer, std::move(batch));
      renderer.Sweep();
      for (auto& count : counts) count.set_value(renderer.Count());
      lock.lock();
    }
  }

  // Takes all requests for the snapshot of the request that has waited longest.
  Batch TakeBatch() GSV_REQUIRES(mutex_) {
    std::erase_if(queue_, [](const auto& request) { return request->abandoned; });
    Batch batch;
    if (queue_.empty()) return batch;
    const auto snapshot = queue_.front()->snapshot;
    std::size_t views = 0;
    std::erase_if(queue_, [&](std::shared_ptr<Request>& request) {
      if (request->snapshot != snapshot) return false;
      if (!batch.empty() && views + request->views.size() > kMaxBatchSize) return false;
      views += request->views.size();
      batch.push_back(std::move(request));
      return true;
    });
    return batch;
  }

  static void Serve(BatchRenderer& renderer, Batch batch) {
    const auto with_depth = std::stable_partition(
        batch.begin(), batch.end(), [](const auto& each) { return each->depth_spacing == 0; });
    const auto surveys = std::stable_partition(
        batch.begin(), with_depth, [](const auto& request) { return !request->is_survey; });
    const world::Snapshot& snapshot = *batch.front()->snapshot;
    const std::span images(batch.begin(), surveys), truths(surveys, with_depth),
        depths(with_depth, batch.end());
    Result<Images> drawn;
    Result<Truths> surveyed;
    if (!images.empty()) drawn = renderer.Draw(snapshot, ViewsOf(images));
    if (!truths.empty()) surveyed = renderer.DrawGroundTruth(snapshot, ViewsOf(truths));
    std::vector<Result<ImageWithDepth>> drawn_with_depth;
    for (const auto& request : depths) {
      drawn_with_depth.push_back(
          renderer.DrawWithDepth(snapshot, request->views[0], request->depth_spacing));
    }
    Serve(images, std::move(drawn), &Request::images);
    Serve(truths, std::move(surveyed), &Request::truths);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      depths[i]->snapshot.reset();
      depths[i]->with_depth.set_value(std::move(drawn_with_depth[i]));
    }
  }

  static std::vector<CameraView> ViewsOf(std::span<const std::shared_ptr<Request>> requests) {
    std::vector<CameraView> views;
    for (const auto& request : requests) {
      views.insert(views.end(), request->views.begin(), request->views.end());
    }
    return views;
  }

  // Distributes the results to the requests of the batch, in order.
  template <typename Product>
  static void Serve(std::span<const std::shared_ptr<Request>> requests, Result<Product> made,
                    std::promise<Result<Product>> Request::*promise) {
    std::size_t first = 0;
    for (const auto& request : requests) {
      // Release the request's data before the caller continues, because the caller may count copies
      // that are in use.
      request->snapshot.reset();
      const std::size_t count = request->views.size();
      if (made) {
        ((*request).*promise)
            .set_value(Product(made->begin() + static_cast<std::ptrdiff_t>(first),
                               made->begin() + static_cast<std::ptrdiff_t>(first + count)));
      } else {
        request->Fail(made.error());
      }
      first += count;
    }
  }

  void EndAll() {
    const base::MutexLock lock(mutex_);
    for (const auto& request : queue_) {
      request->Fail({ErrorCode::kEnded, "the renderer has been shut down", {}});
    }
    queue_.clear();
    for (auto& count : counts_) count.set_value({});
    counts_.clear();
  }

  const RendererOptions options_;
  base::Mutex mutex_;
  base::ConditionVariable work_;
  std::deque<std::shared_ptr<Request>> queue_ GSV_GUARDED_BY(mutex_);
  std::vector<std::promise<DrawCopies>> counts_ GSV_GUARDED_BY(mutex_);
  bool stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

Renderer::Renderer() = default;
Renderer::~Renderer() = default;

Result<std::shared_ptr<Renderer>> Renderer::Start(RendererOptions options) {
  auto renderer = std::shared_ptr<Renderer>(new Renderer);
  renderer->thread_ = std::make_unique<RenderThread>(std::move(options));
  Result<std::string> name = renderer->thread_->Start();
  if (!name) return Fail(name.error());
  renderer->renderer_name_ = std::move(*name);
  return renderer;
}

Result<std::shared_ptr<const model::Image>> Renderer::Draw(
    std::shared_ptr<const world::Snapshot> snapshot, const CameraView& view,
    std::chrono::milliseconds timeout) {
  Result<Images> images = Draw(std::move(snapshot), std::vector{view}, timeout);
  if (!images) return Fail(images.error());
  return std::move(images->front());
}

Result<Images> Renderer::Draw(std::shared_ptr<const world::Snapshot> snapshot,
                              const std::vector<CameraView>& views,
                              std::chrono::milliseconds timeout) {
  GSV_CHECK(snapshot != nullptr);
  for (const CameraView& view : views) {
    if (base::Status status = Check(view.parameters); !status) return Fail(status.error());
  }
  return thread_->Draw(std::move(snapshot), views, timeout);
}

Result<ImageWithDepth> Renderer::DrawWithDepth(std::shared_ptr<const world::Snapshot> snapshot,
                                               const CameraView& view, int spacing,
                                               std::chrono::milliseconds timeout) {
  GSV_CHECK(snapshot != nullptr && spacing > 0);
  if (base::Status status = Check(view.parameters); !status) return Fail(status.error());
  return thread_->DrawWithDepth(std::move(snapshot), view, spacing, timeout);
}

Result<Truths> Renderer::DrawGroundTruth(std::shared_ptr<const world::Snapshot> snapshot,
                                         const std::vector<CameraView>& views,
                                         std::chrono::milliseconds timeout) {
  GSV_CHECK(snapshot != nullptr);
  for (const CameraView& view : views) {
    if (base::Status status = Check(view.parameters); !status) return Fail(status.error());
  }
  return thread_->DrawGroundTruth(std::move(snapshot), views, timeout);
}

DrawCopies Renderer::CountCopies() { return thread_->Count(); }

}  // namespace gsv::rendering
