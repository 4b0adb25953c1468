// The events of a simulation, and the observers that are notified of them.
//
// Threads  any; the log has its own lock, and takes no other lock while it holds this one.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/history/snapshot_history.h"
#include "gsv/simulation/observer.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

// Stores the events of a simulation, and notifies its observers.
class EventLog {
 public:
  // Events carry the step and time of the latest snapshot of `history`, which must outlive the log.
  // The log keeps the newest `capacity` events.
  explicit EventLog(const SnapshotHistory& history, std::size_t capacity = 10'000)
      : history_(history), events_{capacity}, outputs_{kMaxOutputs} {}

  // Appends an event and notifies every observer. The log's lock is held while observers are
  // notified.
  void Emit(std::string kind, std::string robot = {}, std::string detail = {},
            std::shared_ptr<const Edit> edit = nullptr);
  // Returns the kept events from number `first` on. The first event of a simulation has the number
  // 0.
  std::vector<Event> Since(std::uint64_t first) const;
  // The number of events so far, including dropped events.
  std::uint64_t count() const;
  // OutputsSince() and output_count() are for lines of output (IsOutput()). Since() and count()
  // leave these lines out.
  std::vector<Event> OutputsSince(std::uint64_t first) const;
  std::uint64_t output_count() const;

  void AddObserver(std::shared_ptr<Observer> observer);
  void RemoveObserver(const std::shared_ptr<Observer>& observer);
  // Calls OnSnapshot() of every observer. No lock is held during these calls.
  void Publish(const std::shared_ptr<const world::Snapshot>& snapshot) const;
  bool has_observers() const { return has_observers_.load(std::memory_order_relaxed); }
  // Whether an observer requests the times of steps.
  bool wants_times() const { return wants_times_.load(std::memory_order_relaxed); }
  // Calls OnTimes() of the observers that request the times of steps. No lock is held during these
  // calls.
  void Publish(const StepTimes& times) const;

 private:
  static constexpr std::size_t kMaxOutputs = 2000;  // number of lines of output that are kept

  // A list of the newest events.
  struct BoundedLog {
    std::size_t capacity = 0;
    std::deque<Event> events{};
    std::uint64_t dropped = 0;  // number of events that were removed at the front

    // Appends an event, and removes the oldest one if the list is full.
    void Add(const Event& event);
    // Returns the kept events from number `first` on.
    std::vector<Event> Since(std::uint64_t first) const;
  };

  // Returns a copy of the list, so that observers can be called without the lock.
  std::vector<std::shared_ptr<Observer>> Observers() const;
  // Updates has_observers_ and wants_times_ after the observers have changed.
  void UpdateFlags() GSV_REQUIRES(mutex_);

  const SnapshotHistory& history_;
  std::atomic<bool> has_observers_ = false, wants_times_ = false;  // results of UpdateFlags()

  mutable base::Mutex mutex_;
  // outputs_ holds the lines of output, and events_ all other events.
  BoundedLog events_ GSV_GUARDED_BY(mutex_);
  BoundedLog outputs_ GSV_GUARDED_BY(mutex_);
  std::vector<std::shared_ptr<Observer>> observers_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
