// Calls behaviours on threads of its own, so that nobody who must not wait does. Calls with one key
// run one after the other, in the order they were posted.
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

class BehaviourCaller {
 public:
  explicit BehaviourCaller(int threads);
  ~BehaviourCaller() { Close(); }
  BehaviourCaller(const BehaviourCaller&) = delete;
  BehaviourCaller& operator=(const BehaviourCaller&) = delete;

  void Post(std::string key, std::function<void()> call);
  // Waits for the calls that are posted. Nothing may be posted after it.
  void Close();
  // Until every call that was posted has returned; false when `timeout` of wall time comes first.
  bool WaitUntilIdle(std::chrono::milliseconds timeout);

 private:
  struct Task {
    std::string key;
    std::function<void()> call;
  };

  void Work();
  // The first task whose key is not in progress; end() if there is none.
  std::deque<Task>::iterator FindRunnable() GSV_REQUIRES(mutex_);

  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::deque<Task> tasks_ GSV_GUARDED_BY(mutex_);
  std::set<std::string> in_progress_ GSV_GUARDED_BY(mutex_);
  bool closing_ GSV_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> threads_;
};

}  // namespace gsv::simulation
