// The snapshots that readings are taken from: the latest, and for each cadence in use the one at
// the newest sampling instant whose readings have arrived.
//
// A sensor with a period P samples at 0, P, 2P, …: its instant k is taken at the first step at or
// after kP, and can be read from the first step that is its latency later. Until the first has
// arrived, the start is read.
//
// Threads  any; Publish() from the stepping thread.
#pragma once

#include <compare>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

struct Cadence {
  base::SimTime period{0};   // 0: a sample at every step, and no latency
  base::SimTime latency{0};  // from the sampling instant until it can be read
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const Cadence&, const Cadence&) = default;
};

class SnapshotHistory {
 public:
  using SnapshotPtr = std::shared_ptr<const world::Snapshot>;

  // What At() gives at one instant, for many who ask without a lock.
  class Frame {
   public:
    const SnapshotPtr& latest() const { return latest_; }
    // The latest where the cadence was not in use when the frame was made.
    const SnapshotPtr& At(const Cadence& cadence) const {
      for (const auto& [known, snapshot] : at_instant_) {
        if (known == cadence) return snapshot;
      }
      return latest_;
    }

   private:
    friend class SnapshotHistory;
    SnapshotPtr latest_;
    std::vector<std::pair<Cadence, SnapshotPtr>> at_instant_;
  };

  explicit SnapshotHistory(SnapshotPtr initial) : latest_(std::move(initial)) {}

  SnapshotPtr latest() const;
  // What a sensor of this cadence reads. A cadence that is new starts with the latest snapshot.
  SnapshotPtr At(const Cadence& cadence);
  // A cadence is in use from the first time that somebody says so. Sensors do when they are
  // mounted, so that those who merely watch leave no trace.
  void Use(const Cadence& cadence) { (void)At(cadence); }
  void MakeFrame(Frame& frame) const;

  void Publish(SnapshotPtr snapshot);
  // The world has changed between two steps (a robot was added): from here on this is the latest,
  // and nothing older is handed out.
  void Restart(SnapshotPtr snapshot);

 private:
  struct Kept {
    SnapshotPtr arrived;
    std::deque<SnapshotPtr> coming;  // as many as the latency holds periods, at most
  };

  mutable base::Mutex mutex_;
  SnapshotPtr latest_ GSV_GUARDED_BY(mutex_);
  std::map<Cadence, Kept> kept_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
