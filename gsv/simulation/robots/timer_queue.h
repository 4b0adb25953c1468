// A queue of waiting objects (sleepers), ordered by the instant at which they wake. A sleeper
// checks its own clocks when it is woken, so superfluous entries do no harm.
//
// If a sleeper has a function Prefetch(), it is called some time before the sleeper is woken, to
// load data into the cache.
//
// Threads  the owner synchronises access.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "gsv/base/sim_time.h"

namespace gsv::simulation {

template <typename Sleeper>
class TimerQueue {
 public:
  // Adds a sleeper, which wakes at this instant.
  void Add(base::SimTime instant, Sleeper* sleeper) {
    auto day = entries_.lower_bound(instant);
    if (day == entries_.end() || day->first != instant) {
      day = entries_.emplace_hint(day, instant, std::move(spare_));
      spare_ = {};
    }
    day->second.push_back(sleeper);
  }

  // Whether the instant of a sleeper is reached.
  bool HasDue(base::SimTime now) const {
    return !entries_.empty() && entries_.begin()->first <= now;
  }

  // Returns the first instant at which a sleeper wakes; `limit` if there is none before it.
  base::SimTime Next(base::SimTime limit) const {
    return entries_.empty() ? limit : std::min(limit, entries_.begin()->first);
  }

  // Removes the sleepers whose instant is reached, and calls `wake` for each in the order of the
  // instants. Sleepers with equal instants wake in the order in which they were added.
  template <typename Wake>
  void TakeDue(base::SimTime now, const Wake& wake) {
    while (HasDue(now)) {
      std::vector<Sleeper*> due = std::move(entries_.begin()->second);
      entries_.erase(entries_.begin());
      for (std::size_t i = 0; i < due.size(); ++i) {
        if constexpr (requires(Sleeper & sleeper) { sleeper.Prefetch(); }) {
          if (i + kAhead < due.size()) due[i + kAhead]->Prefetch();
        }
        wake(*due[i]);
      }
      due.clear();
      if (due.capacity() > spare_.capacity()) spare_ = std::move(due);
    }
  }

  // Removes the sleepers whose instant is reached, and appends them to `due` in the order in which
  // the other TakeDue() would wake them.
  void TakeDue(base::SimTime now, std::vector<Sleeper*>& due) {
    while (HasDue(now)) {
      std::vector<Sleeper*> first = std::move(entries_.begin()->second);
      entries_.erase(entries_.begin());
      due.insert(due.end(), first.begin(), first.end());
      first.clear();
      if (first.capacity() > spare_.capacity()) spare_ = std::move(first);
    }
  }

  // Removes all entries of a sleeper.
  void Remove(const Sleeper* sleeper) {
    for (auto& [instant, sleepers] : entries_) std::erase(sleepers, sleeper);
  }
  // Removes all entries.
  void Clear() { entries_.clear(); }

 private:
  // When sleeper i of an instant is woken, the data of sleeper i + kAhead is prefetched into the
  // cache.
  static constexpr std::size_t kAhead = 8;

  std::map<base::SimTime, std::vector<Sleeper*>> entries_;  // sleepers by their instants
  std::vector<Sleeper*> spare_;                             // kept for reuse by the next entry
};

}  // namespace gsv::simulation
