// The instants 0, P, 2P, … of simulated time. An instant is represented by the first snapshot at or
// after it.
#pragma once

#include "gsv/base/check.h"
#include "gsv/base/sim_time.h"

namespace gsv::recording {

class Instants {
 public:
  explicit Instants(base::SimTime period) : period_(period) { GSV_CHECK(period.count() > 0); }

  // Returns whether an instant is later than the time of the last call, and not later than `time`.
  // The first call returns whether `time` is an instant.
  bool AdvanceTo(base::SimTime time) {
    if (time >= from_ && time < to_) return false;
    const std::int64_t index = time / period_;
    const bool has_come = index_ < 0 ? time % period_ == base::SimTime(0) : index != index_;
    index_ = index;
    from_ = index * period_;
    to_ = from_ + period_;
    return has_come;
  }

  // The first time after the last call's at which AdvanceTo() returns true.
  base::SimTime next() const { return to_; }

 private:
  base::SimTime period_;
  std::int64_t index_ = -1;  // index of the newest instant that has passed
  // The newest instant and the next one. For times between them, AdvanceTo() needs no division.
  base::SimTime from_{}, to_{};
};

}  // namespace gsv::recording
