// Stores the snapshots that sensors read. These are the latest snapshot and, for each cadence in
// use, the newest snapshot at a sampling instant whose readings are already available.
//
// A sensor with the period P samples at 0, P, 2P, …. Sample k is taken at the first step at or
// after kP. It becomes available at the first step at which the latency has passed. Before the
// first sample is available, a sensor reads the state at the start.
//
// Threads  any; Publish() from the stepping thread.
#pragma once

#include <compare>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// When a sensor takes samples, and when they are available.
struct Cadence {
  base::SimTime period{0};   // 0 means a sample at every step, without a latency
  base::SimTime latency{0};  // the time from the sampling instant until the sample is available
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const Cadence&, const Cadence&) = default;
};

// Stores the snapshots that sensors read at their update rates.
class SnapshotHistory {
 public:
  using SnapshotPtr = std::shared_ptr<const world::Snapshot>;

  // The snapshots that sensors of each cadence read at one instant. Many threads can read a frame
  // without a lock.
  class Frame {
   public:
    const SnapshotPtr& latest() const { return latest_; }
    // Returns the snapshot that a sensor with this cadence reads. This is the latest snapshot if
    // the cadence was not in use when the frame was made.
    const SnapshotPtr& At(const Cadence& cadence) const {
      for (const auto& [known, snapshot] : at_instant_) {
        if (known == cadence) return snapshot;
      }
      return latest_;
    }

   private:
    friend class SnapshotHistory;
    SnapshotPtr latest_;
    std::vector<std::pair<Cadence, SnapshotPtr>> at_instant_;  // by cadence, what At() returns
  };

  explicit SnapshotHistory(SnapshotPtr initial) : latest_(std::move(initial)) {}

  SnapshotPtr latest() const;
  // Returns the snapshot that a sensor with this cadence reads. A new cadence starts with the
  // latest snapshot.
  SnapshotPtr At(const Cadence& cadence);
  // Registers a cadence. Sensors call this when they are mounted. So a sensor's readings do not
  // depend on when it is read for the first time, for example by an observer.
  void Use(const Cadence& cadence) { (void)At(cadence); }
  // Fills `frame` with the snapshots that sensors read now.
  void MakeFrame(Frame& frame) const;

  // Returns the first instant after the latest snapshot that is a sampling instant of a cadence;
  // `limit` if there is none before it.
  base::SimTime NextSampling(base::SimTime limit) const;

  // Adds the snapshot of the newest step. No step at a sampling instant may be left out.
  void Publish(SnapshotPtr snapshot);
  // Restarts the history at the start of a run. Older snapshots are dropped.
  void Restart(SnapshotPtr snapshot);
  // Replaces the latest snapshot after a change of the world between two steps, such as an added
  // robot. The samples of sensors stay what they are: `carry_over` returns an earlier snapshot with
  // the bodies of the changed world.
  void Change(SnapshotPtr latest,
              const std::function<SnapshotPtr(const world::Snapshot&)>& carry_over);

 private:
  // The samples of one cadence.
  struct Samples {
    SnapshotPtr arrived;  // the newest sample whose latency has passed
    // snapshots whose latency has not passed; their maximum number is the latency divided by the
    // period
    std::deque<SnapshotPtr> coming;
  };

  mutable base::Mutex mutex_;
  SnapshotPtr latest_ GSV_GUARDED_BY(mutex_);  // the snapshot of the newest step
  // The samples of each cadence in use.
  std::map<Cadence, Samples> kept_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
