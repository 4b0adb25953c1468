#include "gsv/gateway/drawing/view_drawer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "gsv/base/sorting.h"
#include "gsv/rendering/images/depth_segment.h"
#include "gsv/rendering/images/jpeg.h"
#include "gsv/rendering/images/png.h"

namespace gsv::gateway::drawing {
namespace {

using base::ErrorCode;
using base::Fail;

// The interval between two checks whether a world with pending requests has changed.
constexpr std::chrono::milliseconds kCheckInterval{5};
// Sources of worlds without requests are released after this time.
constexpr std::chrono::seconds kUnusedSourceTimeout{10};
constexpr std::size_t kKeptImages = 16;

base::Error Ended() { return {ErrorCode::kEnded, "the server is shutting down", {}}; }

}  // namespace

ViewDrawer::ViewDrawer(const DrawingLimits& limits) : limits_(limits), thread_([this] { Run(); }) {}

ViewDrawer::~ViewDrawer() { Stop(); }

base::Result<std::shared_ptr<ViewDrawer::Seat>> ViewDrawer::Take(const ViewRequest& request) {
  const std::int64_t pixels = std::int64_t{request.camera.width} * request.camera.height;
  if (pixels > limits_.pixels) {
    return Fail(ErrorCode::kInvalidArgument,
                fmt::format("an image of {} pixels is too large; the limit is {} pixels", pixels,
                            limits_.pixels));
  }
  const base::MutexLock lock(mutex_);
  std::erase_if(seats_, [](const auto& seat) { return seat.expired(); });
  if (seats_.size() >= limits_.viewers) {
    return Fail(
        ErrorCode::kUnavailable,
        fmt::format(
            "{} viewers already get images from the server, which is the limit; close one of them",
            limits_.viewers));
  }
  const std::vector<ViewRequest> views = Views();
  const bool is_shared = std::find(views.begin(), views.end(), request) != views.end();
  if (!is_shared && views.size() >= limits_.views) {
    return Fail(ErrorCode::kUnavailable,
                fmt::format("the server already draws {} views, which is the limit; close one of "
                            "them, or request a view that is already drawn",
                            limits_.views));
  }
  auto seat = std::make_shared<Seat>(request);
  seats_.push_back(seat);
  return seat;
}

std::vector<ViewRequest> ViewDrawer::Views() const {
  std::vector<ViewRequest> views;
  for (const auto& weak : seats_) {
    const auto seat = weak.lock();
    if (!seat) continue;
    const bool is_known = std::find(views.begin(), views.end(), seat->request()) != views.end();
    if (!is_known) views.push_back(seat->request());
  }
  return views;
}

metrics::DrawnViews ViewDrawer::Counts() {
  const base::MutexLock lock(mutex_);
  std::erase_if(seats_, [](const auto& seat) { return seat.expired(); });
  return {Views().size(), seats_.size(), images_};
}

void ViewDrawer::SetSource(const std::string& world, const std::weak_ptr<const void>& identity,
                           const MakeSource& make) {
  const base::MutexLock lock(mutex_);
  World& entry = worlds_[world];
  entry.used = Clock::now();
  if (entry.source != nullptr && entry.identity.lock() == identity.lock()) return;
  entry.identity = identity;
  entry.source = make();
  entry.snapshot = nullptr;
}

void ViewDrawer::Ask(std::shared_ptr<Seat> seat, std::uint64_t after, Clock::time_point earliest,
                     std::chrono::milliseconds timeout, Answer answer) {
  {
    const base::MutexLock lock(mutex_);
    if (!stopping_) {
      const auto begin = std::max(Clock::now(), earliest);
      pending_.push_back({std::move(seat), after, earliest, begin + timeout, std::move(answer)});
      changed_.notify_all();
      return;
    }
  }
  answer(Fail(Ended()));
}

bool ViewDrawer::Withdraw(const Seat& seat) {
  const base::MutexLock lock(mutex_);
  return std::erase_if(pending_, [&](const Pending& each) { return each.seat.get() == &seat; }) > 0;
}

void ViewDrawer::Stop() {
  {
    const base::MutexLock lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void ViewDrawer::Run() {
  for (;;) {
    std::vector<std::string> wanted;
    {
      base::MutexLock lock(mutex_);
      DropUnused();
      changed_.wait_for(lock, kUnusedSourceTimeout,
                        [this]() GSV_REQUIRES(mutex_) { return stopping_ || !pending_.empty(); });
      if (stopping_) break;
      for (const Pending& each : pending_) wanted.push_back(each.seat->request().world);
    }
    base::Sort(wanted);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    bool has_served = false;
    for (const std::string& name : wanted) has_served = Serve(name) || has_served;
    if (has_served || wanted.empty()) continue;
    base::MutexLock lock(mutex_);
    const std::size_t known = pending_.size();
    changed_.wait_for(lock, kCheckInterval,
                      [&]() GSV_REQUIRES(mutex_) { return stopping_ || pending_.size() != known; });
  }
  std::vector<Pending> ended;
  {
    const base::MutexLock lock(mutex_);
    ended = std::exchange(pending_, {});
    worlds_.clear();
  }
  for (const Pending& each : ended) each.answer(Fail(Ended()));
}

void ViewDrawer::DropUnused() {
  const auto now = Clock::now();
  std::erase_if(worlds_, [&](const auto& entry) GSV_REQUIRES(mutex_) {
    const bool is_wanted = std::any_of(pending_.begin(), pending_.end(), [&](const Pending& each) {
      return each.seat->request().world == entry.first;
    });
    return !is_wanted && now - entry.second.used > kUnusedSourceTimeout;
  });
  if (worlds_.empty()) kept_.clear();
}

bool ViewDrawer::Serve(const std::string& name) {
  std::shared_ptr<ViewSource> source;
  {
    const base::MutexLock lock(mutex_);
    const auto found = worlds_.find(name);
    if (found != worlds_.end()) source = found->second.source;
  }
  base::Result<ViewInstant> instant =
      source ? source->Now()
             : base::Result<ViewInstant>(
                   Fail(ErrorCode::kEnded, "the simulation does not exist any more"));
  Seen seen;
  if (instant) {
    const base::MutexLock lock(mutex_);
    World& world = worlds_[name];
    // If the source was replaced in the meantime, the next call checks the new source.
    if (world.source != source) return true;
    if (world.snapshot != instant->snapshot) {
      world.snapshot = instant->snapshot;
      world.number = ++next_number_;
      world.seen = std::chrono::system_clock::now();
    }
    world.used = Clock::now();
    seen = {world.number, world.seen};
  }
  std::vector<Pending> due = TakeDue(name, seen.number);
  if (due.empty()) return false;
  if (instant) {
    Draw(*instant, seen, std::move(due));
  } else {
    for (const Pending& each : due) each.answer(Fail(instant.error()));
  }
  return true;
}

// Removes the requests of a world that are due, and returns them. `number` is the number of the
// world's state; 0: all requests are due, because the world cannot be drawn.
std::vector<ViewDrawer::Pending> ViewDrawer::TakeDue(const std::string& name,
                                                     std::uint64_t number) {
  std::vector<Pending> due;
  const base::MutexLock lock(mutex_);
  const auto now = Clock::now();
  std::erase_if(pending_, [&](Pending& each) {
    if (each.seat->request().world != name) return false;
    const bool has_changed = each.after != number && now >= each.earliest;
    if (number != 0 && !has_changed && now < each.deadline) return false;
    due.push_back(std::move(each));
    return true;
  });
  return due;
}

void ViewDrawer::Draw(const ViewInstant& instant, const Seen& seen, std::vector<Pending> due) {
  while (!due.empty()) {
    // Takes all requests for the same image out of `due`, because one image answers them all.
    const ViewRequest request = due.front().seat->request();
    const auto others = std::stable_partition(due.begin(), due.end(), [&](const Pending& each) {
      return each.seat->request() == request;
    });
    std::vector<Pending> same(std::make_move_iterator(due.begin()),
                              std::make_move_iterator(others));
    due.erase(due.begin(), others);
    base::Result<DrawnImage> answer;
    const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const CachedImage& kept) {
      return kept.image.number == seen.number && kept.request == request;
    });
    if (known != kept_.end()) {
      answer = known->image;
    } else if (const auto placed = view::Place(request.camera, instant.lookup); !placed) {
      answer = Fail(placed.error());
    } else {
      if (renderer_ == nullptr) {
        auto renderer = rendering::Renderer::Start();
        if (renderer) renderer_ = *std::move(renderer);
        if (!renderer) answer = Fail(renderer.error());
      }
      if (renderer_ != nullptr) {
        const auto bytes = DrawEncoded(*renderer_, instant, *placed, request);
        if (bytes) {
          const base::MutexLock lock(mutex_);
          ++images_;
        }
        answer =
            bytes ? base::Result<DrawnImage>(DrawnImage{*bytes, seen.number, instant.time, seen.at})
                  : Fail(bytes.error());
      }
    }
    if (answer && known == kept_.end()) {
      std::erase_if(kept_, [&](const CachedImage& kept) { return kept.request == request; });
      if (kept_.size() >= kKeptImages) kept_.erase(kept_.begin());
      kept_.push_back({request, *answer});
    }
    for (Pending& each : same) {
      // Releases the Seat before the answer: as soon as the viewer has the answer, it may send its
      // next request, which needs a free Seat.
      each.seat.reset();
      each.answer(answer);
    }
  }
}

base::Result<SharedBytes> ViewDrawer::DrawEncoded(rendering::Renderer& renderer,
                                                  const ViewInstant& instant,
                                                  const rendering::CameraView& view,
                                                  const ViewRequest& request) {
  const bool is_png = request.format == ImageFormat::kPng;
  rendering::ImageWithDepth drawn;
  if (request.depth_spacing > 0 && !is_png) {
    auto image = renderer.DrawWithDepth(instant.snapshot, view, request.depth_spacing);
    if (!image) return Fail(image.error());
    drawn = *std::move(image);
  } else {
    auto image = renderer.Draw(instant.snapshot, view);
    if (!image) return Fail(image.error());
    drawn.image = *std::move(image);
  }
  auto bytes = is_png ? rendering::EncodePng(*drawn.image)
                      : rendering::EncodeJpeg(*drawn.image, request.quality);
  if (!bytes) return Fail(bytes.error());
  if (drawn.depth != nullptr) rendering::InsertDepth(*drawn.depth, *bytes);
  return SharedBytes(*std::move(bytes));
}

}  // namespace gsv::gateway::drawing
