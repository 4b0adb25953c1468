// A thread that executes jobs one after the other.
//
// Threads  any.
// Bounded  Add() refuses a job if too many wait.
#pragma once

#include <deque>
#include <functional>
#include <thread>
#include <utility>

#include "gsv/base/mutex.h"

namespace gsv::ros2 {

class ServiceWorker {
 public:
  using Job = std::function<void()>;

  explicit ServiceWorker(std::size_t max_jobs) : max_jobs_(max_jobs), thread_([this] { Run(); }) {}
  ~ServiceWorker() { Stop(); }
  ServiceWorker(const ServiceWorker&) = delete;
  ServiceWorker& operator=(const ServiceWorker&) = delete;

  // Returns false if the job is refused.
  bool Add(Job job) {
    {
      const base::MutexLock lock(mutex_);
      if (is_stopping_ || jobs_.size() >= max_jobs_) return false;
      jobs_.push_back(std::move(job));
    }
    changed_.notify_one();
    return true;
  }
  // Finishes the current job, drops the waiting jobs and ends the thread.
  void Stop() {
    {
      const base::MutexLock lock(mutex_);
      is_stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }
  bool is_stopping() const {
    const base::MutexLock lock(mutex_);
    return is_stopping_;
  }

 private:
  // The function of thread_: executes the jobs in order.
  void Run() {
    base::MutexLock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return is_stopping_ || !jobs_.empty(); });
      if (is_stopping_) return;
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
      lock.lock();
    }
  }

  const std::size_t max_jobs_;
  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified after changes of jobs_ and is_stopping_
  std::deque<Job> jobs_ GSV_GUARDED_BY(mutex_);
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // declared last, because it uses the members above
};

}  // namespace gsv::ros2
