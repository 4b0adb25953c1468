// Checks a run of a crowd by brute force: the overlaps of all bodies after each step, and one sonar
// reading in a hundred. The computation follows the definitions of the shapes and does not use the
// code of the simulation.
//
// Threads  any thread may check readings; the stepping thread checks overlaps.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "gsv/base/mutex.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

class CrowdCheck final : public simulation::Observer {
 public:
  // Checks the readings of the robot's eight rays at the snapshot.
  void TakeReadings(const world::Snapshot& snapshot, const std::string& robot,
                    const std::vector<double>& readings);

  // Counts overlapping pairs.
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override;
  void OnEvent(const simulation::Event&) override {}

  std::uint64_t readings_checked() const { return readings_checked_; }
  std::uint64_t pairs_checked() const { return pairs_checked_; }
  // Number of differences between the simulation and the check.
  std::uint64_t mismatches() const { return mismatches_; }
  // Returns a sentence about the first difference, or an empty text.
  std::string first_mismatch() const;

 private:
  // Counts a difference. Stores the sentence if this is the first difference.
  void Report(std::string sentence);

  std::atomic<std::uint64_t> readings_checked_{0}, pairs_checked_{0}, mismatches_{0};
  mutable base::Mutex mutex_;
  std::string first_mismatch_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
