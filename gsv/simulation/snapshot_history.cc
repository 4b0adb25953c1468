#include "gsv/simulation/snapshot_history.h"

namespace gsv::simulation {

SnapshotHistory::SnapshotPtr SnapshotHistory::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

SnapshotHistory::SnapshotPtr SnapshotHistory::At(base::SimTime period) {
  const std::lock_guard lock(mutex_);
  if (period.count() <= 0) return latest_;
  return at_instant_.emplace(period, latest_).first->second;
}

void SnapshotHistory::MakeFrame(Frame& frame) const {
  const std::lock_guard lock(mutex_);
  frame.latest_ = latest_;
  frame.at_instant_.assign(at_instant_.begin(), at_instant_.end());
}

void SnapshotHistory::Publish(SnapshotPtr snapshot) {
  const std::lock_guard lock(mutex_);
  const base::SimTime before = latest_->state.time;
  for (auto& [period, kept] : at_instant_) {
    if (snapshot->state.time / period != before / period) kept = snapshot;
  }
  latest_ = std::move(snapshot);
}

void SnapshotHistory::Restart(SnapshotPtr snapshot) {
  const std::lock_guard lock(mutex_);
  for (auto& [period, kept] : at_instant_) kept = snapshot;
  latest_ = std::move(snapshot);
}

}  // namespace gsv::simulation
