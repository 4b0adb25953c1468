// An event on which the calls of an agent wait. It has its own lock, so that many agents that wake
// at one instant do not contend for the simulation's lock.
//
// Threads  any.
#pragma once

#include <cstdint>

#include "gsv/base/mutex.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

// Base class of objects that end an agent's wait. A thread of the simulation calls Open() at the
// end of the wait.
class Wakeable {
 public:
  virtual ~Wakeable() = default;
  virtual void Open() = 0;  // wakes the waiting agent
};

// An event on which threads wait, and which another thread signals.
class WaitEvent final : public Wakeable {
 public:
  // The number of signals so far. To wait for a condition, a thread first reads this number while
  // it holds the lock of the condition. Then it passes the number to WaitAfter(). So the thread
  // also notices a signal between the two calls.
  std::uint64_t signals() const {
    const base::MutexLock lock(mutex_);
    return signals_;
  }

  // Signals the event and so wakes all waiting threads. Waking threads takes a system call.
  void Open() override {
    {
      const base::MutexLock lock(mutex_);
      ++signals_;
    }
    opened_.notify_all();
  }

  // Waits until the number of signals exceeds `signals`, and then returns true. Returns false if
  // this has not happened by the time `until`.
  bool WaitAfter(std::uint64_t signals, WallTime until) {
    base::MutexLock lock(mutex_);
    return opened_.wait_until(lock, until,
                              [&]() GSV_REQUIRES(mutex_) { return signals_ > signals; });
  }

 private:
  mutable base::Mutex mutex_;
  base::ConditionVariable opened_;                    // notified by Open()
  std::uint64_t signals_ GSV_GUARDED_BY(mutex_) = 0;  // see signals()
};

}  // namespace gsv::simulation
