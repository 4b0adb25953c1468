#include "gsv/simulation/history/snapshot_history.h"

#include <algorithm>

namespace gsv::simulation {

SnapshotHistory::SnapshotPtr SnapshotHistory::latest() const {
  const base::MutexLock lock(mutex_);
  return latest_;
}

SnapshotHistory::SnapshotPtr SnapshotHistory::At(const Cadence& cadence) {
  const base::MutexLock lock(mutex_);
  if (cadence.period.count() <= 0) return latest_;
  return kept_.try_emplace(cadence, Samples{latest_, {}}).first->second.arrived;
}

void SnapshotHistory::MakeFrame(Frame& frame) const {
  const base::MutexLock lock(mutex_);
  frame.latest_ = latest_;
  frame.at_instant_.clear();
  for (const auto& [cadence, kept] : kept_) frame.at_instant_.emplace_back(cadence, kept.arrived);
}

base::SimTime SnapshotHistory::NextSampling(base::SimTime limit) const {
  const base::MutexLock lock(mutex_);
  for (const auto& [cadence, kept] : kept_) {
    limit = std::min(limit, (latest_->state.time / cadence.period + 1) * cadence.period);
  }
  return limit;
}

void SnapshotHistory::Publish(SnapshotPtr snapshot) {
  const base::MutexLock lock(mutex_);
  const base::SimTime before = latest_->state.time, now = snapshot->state.time;
  for (auto& [cadence, kept] : kept_) {
    if (now / cadence.period != before / cadence.period) {
      if (cadence.latency.count() <= 0) {
        kept.arrived = snapshot;
        continue;
      }
      kept.coming.push_back(snapshot);
    }
    while (!kept.coming.empty() && kept.coming.front()->state.time + cadence.latency <= now) {
      kept.arrived = std::move(kept.coming.front());
      kept.coming.pop_front();
    }
  }
  latest_ = std::move(snapshot);
}

void SnapshotHistory::Restart(SnapshotPtr snapshot) {
  const base::MutexLock lock(mutex_);
  for (auto& [cadence, kept] : kept_) kept = {snapshot, {}};
  latest_ = std::move(snapshot);
}

void SnapshotHistory::Change(SnapshotPtr latest,
                             const std::function<SnapshotPtr(const world::Snapshot&)>& carry_over) {
  const base::MutexLock lock(mutex_);
  // Cadences share snapshots.
  std::vector<std::pair<SnapshotPtr, SnapshotPtr>> changed{{latest_, latest}};
  const auto change = [&](SnapshotPtr& snapshot) {
    const auto known = std::find_if(changed.begin(), changed.end(),
                                    [&](const auto& pair) { return pair.first == snapshot; });
    if (known == changed.end()) {
      changed.emplace_back(snapshot, carry_over(*snapshot));
      snapshot = changed.back().second;
    } else {
      snapshot = known->second;
    }
  };
  for (auto& [cadence, kept] : kept_) {
    change(kept.arrived);
    for (SnapshotPtr& coming : kept.coming) change(coming);
  }
  latest_ = std::move(latest);
}

}  // namespace gsv::simulation
