#include "gsv/ros2/slow_lane.h"

#include <pthread.h>

#include <utility>

namespace gsv::ros2 {
namespace {

// The number of images that are requested before the thread waits for the first of them. The
// renderer renders these images together.
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
    if (jobs_.size() == kMaxWaiting) {
      jobs_.pop_front();
      ++skipped_;
    }
    jobs_.push_back({std::move(sources), moment});
  }
  changed_.notify_all();
}

void SlowLane::Drain() {
  base::MutexLock lock(mutex_);
  changed_.wait(lock, [this]() GSV_REQUIRES(mutex_) {
    return is_stopping_ || (jobs_.empty() && !is_working_);
  });
}

std::uint64_t SlowLane::skipped() const {
  const base::MutexLock lock(mutex_);
  return skipped_;
}

void SlowLane::Run() {
  pthread_setname_np(pthread_self(), "ros2-images");  // the threads of team_ inherit this name
  base::MutexLock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return !jobs_.empty() || is_stopping_; });
    if (is_stopping_) return;
    {
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      is_working_ = true;
      lock.unlock();
      Do(job);
    }
    lock.lock();
    is_working_ = false;
    changed_.notify_all();
  }
}

void SlowLane::Do(const Job& job) {
  if (job.sources.size() == 1) return job.sources.front()->Publish(job.moment);
  if (team_ == nullptr) team_ = std::make_unique<base::ThreadTeam>(kAtOnce);
  team_->ParallelFor(job.sources.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) job.sources[i]->Publish(job.moment);
  });
}

}  // namespace gsv::ros2
