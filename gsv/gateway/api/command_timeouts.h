// A dead man's switch: a robot that a user drives is stopped if no further command arrives in time.
//
// A page repeats its command while a key is held. If the page, its browser or the network fails,
// the repetition ends, and the robot must not continue for ever.
//
// Time     wall-clock time.
// Bounded  one function for each key.
// Threads  any. The functions run on a thread of this object.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "gsv/base/mutex.h"

namespace gsv::gateway {

// Runs the function of a key after a timeout. Before that, the function can be replaced or
// cancelled.
class CommandTimeouts {
 public:
  CommandTimeouts();
  // Drops the functions that have not run.
  ~CommandTimeouts();
  CommandTimeouts(const CommandTimeouts&) = delete;
  CommandTimeouts& operator=(const CommandTimeouts&) = delete;

  // Calls `stop` after `timeout`. Replaces the pending function of the same key.
  void Set(const std::string& key, std::chrono::nanoseconds timeout, std::function<void()> stop);
  // Drops the pending function of this key, if there is one.
  void Cancel(const std::string& key);

 private:
  using Clock = std::chrono::steady_clock;
  // A pending function, and the time at which it runs.
  struct Entry {
    Clock::time_point due;  // when `stop` is called
    std::function<void()> stop;
  };

  // The main function of the thread.
  void Run();

  base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified by Set() and by the destructor
  std::map<std::string, Entry> entries_ GSV_GUARDED_BY(mutex_);  // pending functions by key
  bool stopping_ GSV_GUARDED_BY(mutex_) = false;                 // set by the destructor
  std::thread thread_;                                           // executes Run()
};

}  // namespace gsv::gateway
