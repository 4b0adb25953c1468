// The publisher's queue. It holds events, and snapshots from which at least one message must be
// published.
//
// Threads  OnSnapshot() and OnEvent(): the threads that simulation::Observer names. Next(): one
//          thread. Other functions: any thread.
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

  // From now on, queues the first snapshot at or after each multiple of each period, and no others.
  void SetPeriods(const std::set<base::SimTime>& periods);

  // The entries that Next() returns.
  struct News {
    SnapshotPointer snapshot;  // null if there is no new snapshot
    std::vector<simulation::Event> events;
  };
  // Returns the oldest queued snapshot and all queued events. If the queue is empty, waits until
  // there is an entry, Wake() or Close() is called, or `timeout` (wall-clock time) has passed.
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
  // The key is a requested period. The value computes the instants at which a snapshot is due.
  std::map<base::SimTime, recording::Instants> instants_ GSV_GUARDED_BY(mutex_);
  std::deque<SnapshotPointer> snapshots_ GSV_GUARDED_BY(mutex_);
  std::vector<simulation::Event> events_ GSV_GUARDED_BY(mutex_);
  std::uint64_t dropped_ GSV_GUARDED_BY(mutex_) = 0;  // number of dropped snapshots
  bool is_woken_ GSV_GUARDED_BY(mutex_) = false;  // whether Wake() was called since the last Next()
  bool is_closed_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::ros2
