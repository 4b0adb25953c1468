// The lock on a simulated world, which detects a stuck simulation.
//
// A behaviour in this process cannot be interrupted. If it does not return from its turn, its
// simulation is stuck. The stepping thread then keeps the lock, and other threads get an error
// instead of waiting forever.
//
// Threads  any.
#pragma once

#include <atomic>
#include <chrono>

#include "gsv/base/mutex.h"

namespace gsv::simulation {

// Stands for the mutex of a world in the thread-safety analysis. The parts of a simulation reach
// the mutex by different references, but the analysis needs one name for all of them.
class GSV_CAPABILITY("mutex") WorldMutex {};
inline WorldMutex world_mutex;

// A mutex of a simulated world. Threads that wait for it get an error if the simulation is stuck.
class WorldLock {
 public:
  // Waiting threads check at this interval whether the simulation is stuck.
  static constexpr std::chrono::milliseconds kPollPeriod{100};

  bool is_stuck() const { return is_stuck_; }
  void SetStuck(bool is_stuck) { is_stuck_ = is_stuck; }

 private:
  friend class SteppingWorldGuard;
  friend class WorldGuard;

  base::TimedMutex mutex_;
  std::atomic<bool> is_stuck_{false};
};

// Locks the world for the lifetime of this object. For the stepping thread only.
class GSV_SCOPED_CAPABILITY SteppingWorldGuard {
 public:
  explicit SteppingWorldGuard(WorldLock& world) GSV_ACQUIRE(world_mutex) : lock_(world.mutex_) {}
  ~SteppingWorldGuard() GSV_RELEASE() = default;
  SteppingWorldGuard(const SteppingWorldGuard&) = delete;
  SteppingWorldGuard& operator=(const SteppingWorldGuard&) = delete;

 private:
  const base::TimedMutexLock lock_;
};

// Locks the world for the lifetime of this object. For all threads except the stepping thread. If
// the simulation is stuck, the lock is not taken. Callers must check is_held(), which the
// thread-safety analysis cannot verify.
class GSV_SCOPED_CAPABILITY WorldGuard {
 public:
  explicit WorldGuard(WorldLock& world) GSV_ACQUIRE(world_mutex) : world_(world) { Lock(); }
  ~WorldGuard() GSV_RELEASE() {
    if (is_held_) Unlock();
  }
  WorldGuard(const WorldGuard&) = delete;
  WorldGuard& operator=(const WorldGuard&) = delete;

  bool is_held() const { return is_held_; }

 private:
  // The thread-safety analysis is off here, because it knows the mutex only as world_mutex.
  void Lock() GSV_NO_THREAD_SAFETY_ANALYSIS {
    while (!is_held_ && !world_.is_stuck()) {
      is_held_ = world_.mutex_.try_lock_for(WorldLock::kPollPeriod);
    }
  }
  // Unlocks the world's mutex.
  void Unlock() GSV_NO_THREAD_SAFETY_ANALYSIS { world_.mutex_.unlock(); }

  WorldLock& world_;
  bool is_held_ = false;
};

}  // namespace gsv::simulation
