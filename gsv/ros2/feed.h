// The publisher's queue of events and of snapshots for which messages are due.
//
// Threads  OnSnapshot() and OnEvent() as simulation::Observer; Next() from one thread; other
//          functions from any thread.
// Bounded  a few snapshots. If the publisher is too slow, the oldest snapshots are dropped. In
//          lockstep, the stepping thread waits instead.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/recording/topics/instants.h"
#include "gsv/simulation/observer.h"

namespace gsv::ros2 {

using SnapshotPointer = std::shared_ptr<const world::Snapshot>;

// Receives the simulation's snapshots and events, and queues them for the publisher.
class Feed final : public simulation::Observer {
 public:
  explicit Feed(bool waits_when_full) : waits_when_full_(waits_when_full) {}

  void OnSnapshot(const SnapshotPointer& snapshot) override;
  void OnEvent(const simulation::Event& event) override;

  // Requests snapshots at multiples of these periods.
  void SetPeriods(const std::set<base::SimTime>& periods);

  // The entries that Next() returns.
  struct News {
    SnapshotPointer snapshot;  // null if there is no new snapshot
    std::vector<simulation::Event> events;
  };
  // Returns the new entries. If there are none, waits for an entry, until `timeout` (wall-clock
  // time) or until Wake() is called.
  News Next(std::chrono::milliseconds timeout);
  // Ends the wait of Next() early.
  void Wake();
  // Closes the queue, and releases a stepping thread that waits.
  void Close();
  std::uint64_t dropped() const;  // number of dropped snapshots

 private:
  static constexpr std::size_t kMaxSnapshots = 16;
  static constexpr std::size_t kMaxEvents = 1000;  // further events are dropped

  const bool waits_when_full_;  // true in lockstep: the stepping thread waits for space
  mutable base::Mutex mutex_;
  base::ConditionVariable news_;  // notified when Next() can return
  base::ConditionVariable room_;  // notified when the queue has space for a snapshot
  // The instants of each requested period, by period.
  std::map<base::SimTime, recording::Instants> instants_ GSV_GUARDED_BY(mutex_);
  std::deque<SnapshotPointer> snapshots_ GSV_GUARDED_BY(mutex_);
  std::vector<simulation::Event> events_ GSV_GUARDED_BY(mutex_);
  std::uint64_t dropped_ GSV_GUARDED_BY(mutex_) = 0;
  bool is_woken_ GSV_GUARDED_BY(mutex_) = false;  // whether Wake() was called since the last Next()
  bool is_closed_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::ros2
