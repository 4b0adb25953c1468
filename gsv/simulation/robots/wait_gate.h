// What the threads of an agent's waiting calls wait at. It has a lock of its own, so that a crowd
// that is woken at one instant does not queue up for the simulation's lock, which its stepping
// thread needs as well.
//
// Threads  any.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

class WaitGate {
 public:
  // How often it has been opened. Who reads this under the lock that guards what it waits for, and
  // then waits beyond it, misses nothing.
  std::uint64_t openings() const {
    const std::lock_guard lock(mutex_);
    return openings_;
  }

  // Lets all pass who wait now; dear (a system call) where somebody waits.
  void Open() {
    {
      const std::lock_guard lock(mutex_);
      ++openings_;
    }
    opened_.notify_all();
  }

  // Waits until it has been opened more often than `openings`. False when `until` comes first.
  bool WaitBeyond(std::uint64_t openings, WallTime until) {
    std::unique_lock lock(mutex_);
    return opened_.wait_until(lock, until, [&] { return openings_ > openings; });
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable opened_;
  std::uint64_t openings_ = 0;
};

}  // namespace gsv::simulation
