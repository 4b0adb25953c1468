// Wakes the stepping thread. A thread of this process can wake it. A client can also wake it,
// through the memory that the client shares with the simulation.
//
// Threads  any.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <optional>

#include "gsv/base/mutex.h"
#include "gsv/exchange/cycle_memory.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

// A replacement for base::ConditionVariable. All waits use the same lock.
class StepSignal {
 public:
  StepSignal() = default;
  StepSignal(const StepSignal&) = delete;
  StepSignal& operator=(const StepSignal&) = delete;

  // Signals, and wakes all waiting threads.
  void notify_all() {
    exchange::Bell& bell = *bell_.load();
    bell.rings.fetch_add(1);
    if (sleepers_.load() > 0) exchange::FutexWake(bell.rings);
  }

  // Uses the bell of a shared memory from now on. The memory must outlive this object.
  void Use(exchange::Bell& bell) {
    bell_ = &bell;
    own_.rings.fetch_add(1);
    exchange::FutexWake(own_.rings);  // wakes the threads that still sleep on the previous bell
  }

  // A number that changes with each signal. If there was a signal after mark(), a wait with the
  // returned number returns at once.
  std::uint32_t mark() const { return bell_.load()->rings.load(); }

  // Waits until there is a signal after `mark`. If `mark` is not set, waits for a signal after the
  // beginning of this call. May also return early. `lock` is released during the wait.
  std::cv_status wait_until(base::MutexLock& lock, std::optional<WallTime> until,
                            std::optional<std::uint32_t> mark = std::nullopt) {
    exchange::Bell& bell = *bell_.load();
    bell.sleepers.store(static_cast<std::uint32_t>(sleepers_.fetch_add(1) + 1));
    const std::uint32_t seen = mark ? *mark : bell.rings.load();
    lock.unlock();
    const auto end =
        until ? std::optional<std::chrono::nanoseconds>(until->time_since_epoch()) : std::nullopt;
    const bool is_in_time = exchange::FutexWait(bell.rings, seen, end);
    lock.lock();
    bell.sleepers.store(static_cast<std::uint32_t>(sleepers_.fetch_sub(1) - 1));
    return is_in_time ? std::cv_status::no_timeout : std::cv_status::timeout;
  }
  void wait(base::MutexLock& lock, std::uint32_t mark) { wait_until(lock, std::nullopt, mark); }
  template <typename Predicate>
  bool wait_for(base::MutexLock& lock, WallDuration time, Predicate predicate) {
    const WallTime until = WallNow() + time;
    while (!predicate()) {
      if (wait_until(lock, until) == std::cv_status::timeout) return predicate();
    }
    return true;
  }

 private:
  // The bell before Use(), and the bell that is used now.
  exchange::Bell own_{};
  std::atomic<exchange::Bell*> bell_{&own_};
  std::atomic<int> sleepers_{0};  // number of waiting threads; the bell also stores it, for clients
};

}  // namespace gsv::simulation
