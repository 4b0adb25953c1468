#include "gsv/base/thread_team.h"

#include <algorithm>

#include <immintrin.h>

#include "gsv/base/check.h"

namespace gsv::base {
namespace {

// Work often comes in quick succession: a worker looks for it so many times before it sleeps, a few
// microseconds, since to be woken costs more than that.
constexpr int kLooks = 400;

}  // namespace

int ThreadTeam::DefaultThreads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostByDefault);
}

ThreadTeam::ThreadTeam(int threads) {
  GSV_CHECK(threads >= 1);
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { Work(); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  called_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::Run(const Job& job) {
  GSV_CHECK(job.grain > 0);
  job_ = job;
  next_.store(0, std::memory_order_relaxed);
  {
    const std::lock_guard lock(mutex_);
    state_.store(kOpen, std::memory_order_release);
  }
  called_.notify_all();
  TakePieces();
  state_.fetch_and(~kOpen, std::memory_order_relaxed);
  while (state_.load(std::memory_order_acquire) != 0) std::this_thread::yield();
}

void ThreadTeam::TakePieces() {
  for (;;) {
    const std::size_t begin = next_.fetch_add(job_.grain, std::memory_order_relaxed);
    if (begin >= job_.count) return;
    job_.call(job_.work, begin, std::min(begin + job_.grain, job_.count));
  }
}

bool ThreadTeam::TryJoin() {
  unsigned state = state_.load(std::memory_order_acquire);
  while ((state & kOpen) != 0) {
    if (state_.compare_exchange_weak(state, state + 1, std::memory_order_acquire)) return true;
  }
  return false;
}

bool ThreadTeam::Join() {
  for (int i = 0; i < kLooks; ++i) {
    if (TryJoin()) return true;
    _mm_pause();
  }
  bool has_joined = false;
  std::unique_lock lock(mutex_);
  called_.wait(lock, [&] { return is_stopping_ || (has_joined = TryJoin()); });
  return has_joined;
}

void ThreadTeam::Work() {
  while (Join()) {
    TakePieces();
    state_.fetch_sub(1, std::memory_order_release);
  }
}

}  // namespace gsv::base
