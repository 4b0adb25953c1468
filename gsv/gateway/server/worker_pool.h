// A few threads that do what must not be done on the threads that serve everybody.
//
// Bounded  a job that finds the queue full is refused, never kept.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::gateway {

// How many requests of viewers may wait for a thread.
inline constexpr std::size_t kWaitingRequests = 256;

class WorkerPool {
 public:
  WorkerPool(std::size_t threads, std::size_t queue_limit);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // Any thread. False, and the job is gone: the queue is full, or Stop() was called.
  [[nodiscard]] bool Submit(std::function<void()> job);

  // Waits for the jobs that run; those that wait are dropped. Not from a job.
  void Stop();

 private:
  void Work();

  const std::size_t queue_limit_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::deque<std::function<void()>> jobs_;
  bool stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::vector<std::thread> threads_;
};

}  // namespace gsv::gateway
