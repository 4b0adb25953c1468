#include "gsv/base/thread_team.h"

#include <algorithm>

#include <immintrin.h>

#include "gsv/base/check.h"

namespace gsv::base {
namespace {

// An idle worker checks this number of times whether there is a new job, before it yields its
// processor. These checks take some microseconds. Waking a worker takes longer, and jobs often
// follow each other quickly. A caller that waits for its workers also makes this number of checks
// before it sleeps.
constexpr int kPolls = 400;

// A caller that waits for its workers pauses between its first checks. After this number of checks,
// it yields its processor between the checks.
constexpr int kPauses = 50;

// The number of further checks that an idle worker makes after kPolls checks, about 0.1 ms in
// total. Between these checks it yields its processor to other threads. It does not sleep yet,
// because a sleeping worker would join a short job too late to help.
constexpr int kYields = 300;

}  // namespace

int ThreadTeam::DefaultThreads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxDefaultThreads);
}

ThreadTeam::ThreadTeam(int threads) : parts_(static_cast<std::size_t>(std::max(threads, 1))) {
  GSV_CHECK(threads >= 1);
  for (std::size_t i = 1; i < parts_.size(); ++i) workers_.emplace_back([this, i] { Work(i); });
}

ThreadTeam::~ThreadTeam() {
  {
    const MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  called_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::Open(const Job& job) {
  GSV_CHECK(job.grain > 0);
  job_ = job;
  const std::size_t pieces = (job.count + job.grain - 1) / job.grain;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts_[i].next.store(pieces * i / parts_.size() * job.grain, std::memory_order_relaxed);
    parts_[i].end = std::min(pieces * (i + 1) / parts_.size() * job.grain, job.count);
  }
  {
    const MutexLock lock(mutex_);
    state_.store(kOpen, std::memory_order_release);
  }
  called_.notify_all();
}

// The caller first polls, because the workers usually finish soon. Then it sleeps, so that a long
// piece of work does not occupy a second processor.
void ThreadTeam::WaitForWorkers() {
  for (int i = 0; i < kPolls; ++i) {
    if (state_.load(std::memory_order_acquire) == 0) return;
    i < kPauses ? _mm_pause() : std::this_thread::yield();
  }
  while (const unsigned working = state_.load(std::memory_order_acquire)) {
    state_.wait(working, std::memory_order_acquire);
  }
}

void ThreadTeam::RunPieces(std::size_t self) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[(self + i) % parts_.size()];
    for (;;) {
      const std::size_t begin = part.next.fetch_add(job_.grain, std::memory_order_relaxed);
      if (begin >= part.end) break;
      job_.call(job_.work, begin, std::min(begin + job_.grain, part.end), self);
    }
  }
  // No piece is left. The first thread that notices this closes the job, so that no other thread
  // joins it while the last pieces are in progress.
  state_.fetch_and(~kOpen, std::memory_order_relaxed);
  job_.end(job_.work, self);
}

bool ThreadTeam::TryJoin() {
  unsigned state = state_.load(std::memory_order_acquire);
  while ((state & kOpen) != 0) {
    if (state_.compare_exchange_weak(state, state + 1, std::memory_order_acquire)) return true;
  }
  return false;
}

bool ThreadTeam::Join() {
  for (int i = 0; i < kPolls; ++i) {
    if (TryJoin()) return true;
    _mm_pause();
  }
  for (int i = 0; i < kYields && !is_stopping_.load(std::memory_order_relaxed); ++i) {
    if (TryJoin()) return true;
    std::this_thread::yield();
  }
  bool has_joined = false;
  MutexLock lock(mutex_);
  called_.wait(lock,
               [&]() GSV_REQUIRES(mutex_) { return is_stopping_ || (has_joined = TryJoin()); });
  return has_joined;
}

void ThreadTeam::Work(std::size_t self) {
  while (Join()) {
    RunPieces(self);
    state_.fetch_sub(1, std::memory_order_release);
    state_.notify_one();
  }
}

}  // namespace gsv::base
