// The events of a simulation, and the observers that are notified of them.
//
// Threads  any; it has its own lock, and takes no other lock while it holds it.
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

class EventLog {
 public:
  // Events carry the step and time of the latest snapshot of `history`, which outlives the log. The
  // log keeps the newest `capacity` events.
  explicit EventLog(const SnapshotHistory& history, std::size_t capacity = 10'000)
      : history_(history), events_{capacity}, outputs_{kMaxOutputs} {}

  // Appends an event and passes it to every observer, with the log's lock held.
  void Emit(std::string kind, std::string robot = {}, std::string detail = {},
            std::shared_ptr<const Edit> edit = nullptr);
  // Returns the kept events from number `first` on. The first event of a simulation has the number
  // 0.
  std::vector<Event> Since(std::uint64_t first) const;
  // The number of events so far, including dropped ones.
  std::uint64_t count() const;
  // The same for output (IsOutput()), which neither Since() returns nor count() counts.
  std::vector<Event> OutputsSince(std::uint64_t first) const;
  std::uint64_t output_count() const;

  void AddObserver(std::shared_ptr<Observer> observer);
  void RemoveObserver(const std::shared_ptr<Observer>& observer);
  // Passes a snapshot to every observer, without holding a lock.
  void Publish(const std::shared_ptr<const world::Snapshot>& snapshot) const;
  // Whether an observer requests the times of steps.
  bool wants_times() const { return wants_times_.load(std::memory_order_relaxed); }
  // Passes the times of a step to the observers that request them, without holding a lock.
  void Publish(const StepTimes& times) const;

 private:
  static constexpr std::size_t kMaxOutputs = 2000;

  struct Kept {
    std::size_t capacity = 0;
    std::deque<Event> events{};
    std::uint64_t dropped = 0;

    void Add(const Event& event);
    std::vector<Event> Since(std::uint64_t first) const;
  };

  std::vector<std::shared_ptr<Observer>> Observers() const;
  void UpdateWantsTimes() GSV_REQUIRES(mutex_);

  const SnapshotHistory& history_;
  std::atomic<bool> wants_times_ = false;

  mutable base::Mutex mutex_;
  Kept events_ GSV_GUARDED_BY(mutex_);
  Kept outputs_ GSV_GUARDED_BY(mutex_);
  std::vector<std::shared_ptr<Observer>> observers_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
