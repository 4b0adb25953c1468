// The instants 0, P, 2P, … of simulated time. Each of them belongs to the first snapshot at or
// after it.
#pragma once

#include "gsv/base/check.h"
#include "gsv/base/sim_time.h"

namespace gsv::recording {

class Instants {
 public:
  explicit Instants(base::SimTime period) : period_(period) { GSV_CHECK(period.count() > 0); }

  // Returns whether an instant has passed since the snapshot of the last call. The first call
  // returns whether the snapshot is at an instant.
  bool Pass(base::SimTime time) {
    const std::int64_t index = time / period_;
    const bool has_come = index_ < 0 ? time % period_ == base::SimTime(0) : index != index_;
    index_ = index;
    return has_come;
  }

 private:
  base::SimTime period_;
  std::int64_t index_ = -1;  // index of the newest instant that has passed
};

}  // namespace gsv::recording
