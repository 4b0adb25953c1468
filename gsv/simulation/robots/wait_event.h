// An event for which the calls of an agent wait. It has its own lock, so that many agents that wake
// at one instant do not contend for the simulation's lock.
//
// Threads  any.
#pragma once

#include <cstdint>

#include "gsv/base/mutex.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

class WaitEvent {
 public:
  // The number of signals so far. If a thread reads it under the lock of its condition and then
  // calls WaitAfter(), it misses no signal.
  std::uint64_t signals() const {
    const base::MutexLock lock(mutex_);
    return signals_;
  }

  // Signals the event: wakes all waiting threads. This takes a system call if there are any.
  void Open() {
    {
      const base::MutexLock lock(mutex_);
      ++signals_;
    }
    opened_.notify_all();
  }

  // Waits for a signal after the first `signals` ones. Returns false at `until`.
  bool WaitAfter(std::uint64_t signals, WallTime until) {
    base::MutexLock lock(mutex_);
    return opened_.wait_until(lock, until,
                              [&]() GSV_REQUIRES(mutex_) { return signals_ > signals; });
  }

 private:
  mutable base::Mutex mutex_;
  base::ConditionVariable opened_;
  std::uint64_t signals_ GSV_GUARDED_BY(mutex_) = 0;
};

}  // namespace gsv::simulation
