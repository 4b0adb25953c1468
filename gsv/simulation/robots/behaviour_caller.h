// Calls behaviours on its own threads, so that other threads need not wait. Calls with equal keys
// run one after the other, in the order in which they were posted.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::simulation {

// A pool of threads that call behaviours.
class BehaviourCaller {
 public:
  explicit BehaviourCaller(int threads);
  ~BehaviourCaller() { Close(); }
  BehaviourCaller(const BehaviourCaller&) = delete;
  BehaviourCaller& operator=(const BehaviourCaller&) = delete;

  // Adds a call to the queue. Returns at once.
  void Post(std::string key, std::function<void()> call);
  // Waits until all posted calls have returned. No call may be posted afterwards.
  void Close();
  // Waits until every posted call has returned. Returns false after `timeout` of wall-clock time.
  bool WaitUntilIdle(std::chrono::milliseconds timeout);

 private:
  // A posted call.
  struct Task {
    std::string key;  // calls with equal keys run one after the other
    std::function<void()> call;
  };

  // Runs on each thread: makes the posted calls until Close().
  void Work();
  // Returns the first task whose key is not in use by a running call, or end() if there is none.
  std::deque<Task>::iterator FindRunnable() GSV_REQUIRES(mutex_);

  base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified when a task comes, when a call ends, and at the end
  std::deque<Task> tasks_ GSV_GUARDED_BY(mutex_);
  std::set<std::string> in_progress_ GSV_GUARDED_BY(mutex_);  // keys of the running calls
  bool closing_ GSV_GUARDED_BY(mutex_) = false;               // set by Close()
  std::vector<std::jthread> threads_;
};

}  // namespace gsv::simulation
