// The lock on a simulated world, and whether anybody gets it again.
//
// A behaviour in process cannot be interrupted. When it does not return from its turn, its
// simulation is stuck: the stepping thread keeps the lock, and whoever else asks for it is refused
// instead of waiting for ever.
//
// Threads  any.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

namespace gsv::simulation {

class WorldLock {
 public:
  using Held = std::unique_lock<std::timed_mutex>;
  // How soon a waiting thread notices that the simulation is stuck.
  static constexpr std::chrono::milliseconds kLookPeriod{100};

  // For the stepping thread.
  Held Lock() { return Held(mutex_); }
  // For all other threads. What it returns owns nothing if the simulation is stuck.
  Held LockUnlessStuck() const {
    Held held(mutex_, std::defer_lock);
    while (!held.owns_lock() && !is_stuck_) (void)held.try_lock_for(kLookPeriod);
    return held;
  }

  bool is_stuck() const { return is_stuck_; }
  void SetStuck(bool is_stuck) { is_stuck_ = is_stuck; }

 private:
  mutable std::timed_mutex mutex_;
  std::atomic<bool> is_stuck_{false};
};

}  // namespace gsv::simulation
