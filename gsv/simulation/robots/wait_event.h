// What the threads of an agent's waiting calls wait at. It has a lock of its own, so that a crowd
// that is woken at one instant does not queue up for the simulation's lock, which its stepping
// thread needs as well.
//
// Threads  any.
#pragma once

#include <cstdint>

#include "gsv/base/mutex.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

class WaitEvent {
 public:
  // How often it has been opened. Who reads this under the lock that guards what it waits for, and
  // then waits beyond it, misses nothing.
  std::uint64_t signals() const {
    const base::MutexLock lock(mutex_);
    return signals_;
  }

  // Lets all pass who wait now; dear (a system call) where somebody waits.
  void Open() {
    {
      const base::MutexLock lock(mutex_);
      ++signals_;
    }
    opened_.notify_all();
  }

  // Waits until it has been opened more often than `openings`. False when `until` comes first.
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
