// The snapshots that readings are taken from: the latest, and for each sampling period in use the
// one at its newest sampling instant.
//
// A sensor with a period P samples at 0, P, 2P, …: its instant k is taken at the first step at or
// after kP.
//
// Threads  any; Publish() from the stepping thread.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "gsv/world/snapshot.h"

namespace gsv::simulation {

class SnapshotHistory {
 public:
  using SnapshotPtr = std::shared_ptr<const world::Snapshot>;

  // What At() gives at one instant, for many who ask without a lock.
  class Frame {
   public:
    const SnapshotPtr& latest() const { return latest_; }
    // The latest where the period was not in use when the frame was made.
    const SnapshotPtr& At(base::SimTime period) const {
      for (const auto& [known, snapshot] : at_instant_) {
        if (known == period) return snapshot;
      }
      return latest_;
    }

   private:
    friend class SnapshotHistory;
    SnapshotPtr latest_;
    std::vector<std::pair<base::SimTime, SnapshotPtr>> at_instant_;
  };

  explicit SnapshotHistory(SnapshotPtr initial) : latest_(std::move(initial)) {}

  SnapshotPtr latest() const;
  // At the newest instant of a sensor with this period; zero: the latest. A period that is new
  // starts with the latest snapshot.
  SnapshotPtr At(base::SimTime period);
  // A period is in use from the first time that somebody says so. Sensors do when they are mounted,
  // so that those who merely watch leave no trace.
  void Use(base::SimTime period) { (void)At(period); }
  void MakeFrame(Frame& frame) const;

  void Publish(SnapshotPtr snapshot);
  // The world has changed between two steps (a robot was added): from here on this is the latest,
  // and nothing older is handed out.
  void Restart(SnapshotPtr snapshot);

 private:
  mutable std::mutex mutex_;
  SnapshotPtr latest_;
  std::map<base::SimTime, SnapshotPtr> at_instant_;  // by period
};

}  // namespace gsv::simulation
