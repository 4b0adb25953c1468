// When the next step is due on the wall clock, in real time.
//
// A step is late when it starts more than one step after it was due; the schedule then shifts by
// that much, so that nothing is caught up in a burst.
#pragma once

#include <cstdint>

#include "gsv/base/sim_time.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

class Pacer {
 public:
  // `factor` simulated seconds pass in one wall second, > 0.
  Pacer(base::SimTime step, double factor);
  // From now on; the step that is due next comes as long after the one before it.
  void SetRealTimeFactor(double factor);

  // The schedule starts (again) now: the next step is due at once.
  void Restart(WallTime now);
  WallTime due() const { return due_; }
  // A step starts now. True when it is late.
  bool StepStarts(WallTime now);
  std::uint64_t late_steps() const { return late_steps_; }
  void ResetLateSteps() { late_steps_ = 0; }

 private:
  base::SimTime step_;
  WallDuration period_;
  WallTime due_{};
  std::uint64_t late_steps_ = 0;
};

}  // namespace gsv::simulation
