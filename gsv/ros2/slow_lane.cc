#include "gsv/ros2/slow_lane.h"

#include <utility>

namespace gsv::ros2 {
namespace {

// So many images are waited for at once; the renderer draws them together.
constexpr int kAtOnce = 8;

}  // namespace

SlowLane::SlowLane() : thread_([this] { Run(); }) {}

SlowLane::~SlowLane() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void SlowLane::Offer(std::vector<Source*> sources, const Moment& moment, bool waits) {
  if (waits) Drain();
  {
    const base::MutexLock lock(mutex_);
    if (moment_ != nullptr) return;
    sources_ = std::move(sources);
    moment_ = std::make_unique<Moment>(moment);
  }
  changed_.notify_all();
}

void SlowLane::Drain() {
  base::MutexLock lock(mutex_);
  changed_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return moment_ == nullptr || is_stopping_; });
}

void SlowLane::Run() {
  base::MutexLock lock(mutex_);
  for (;;) {
    changed_.wait(lock,
                  [this]() GSV_REQUIRES(mutex_) { return moment_ != nullptr || is_stopping_; });
    if (is_stopping_) return;
    const std::vector<Source*> sources = std::exchange(sources_, {});
    const Moment moment = *moment_;
    lock.unlock();
    if (team_ == nullptr && sources.size() > 1) team_ = std::make_unique<base::ThreadTeam>(kAtOnce);
    if (sources.size() == 1) {
      sources.front()->Publish(moment);
    } else {
      team_->ParallelFor(sources.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sources[i]->Publish(moment);
      });
    }
    lock.lock();
    moment_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace gsv::ros2
