// A WorkerPool is a thread pool for work that must not block the serving threads.
//
// Bounded  a job is refused if the queue is full.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::gateway {

// The queue limit of pools that handle viewers' requests.
inline constexpr std::size_t kWaitingRequests = 256;

// A thread pool with a bounded queue.
class WorkerPool {
 public:
  WorkerPool(std::size_t threads, std::size_t queue_limit);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // Queues a job; any thread may call this. If the queue is full, or after Stop(), drops the job
  // and returns false.
  [[nodiscard]] bool Submit(std::function<void()> job);

  // Waits for running jobs and drops pending jobs. Must not be called from a job.
  void Stop();

 private:
  // The function of each thread.
  void Work();

  const std::size_t queue_limit_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;               // notified by Submit() and Stop()
  std::deque<std::function<void()>> jobs_;        // jobs that have not started
  bool stopping_ GSV_GUARDED_BY(mutex_) = false;  // whether Stop() was called
  std::vector<std::thread> threads_;
};

}  // namespace gsv::gateway
