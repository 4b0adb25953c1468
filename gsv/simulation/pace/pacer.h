// The schedule of steps on the wall clock, in real time.
//
// A step is late if it starts more than one period (step size / real-time factor) after it was due.
// The schedule then shifts by that delay, so that delayed steps do not follow in a burst.
#pragma once

#include <cstdint>

#include "gsv/base/sim_time.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

// Computes when steps are due on the wall clock.
class Pacer {
 public:
  // `factor` is the target real-time factor, > 0.
  Pacer(base::SimTime step, double factor);
  // Sets the target real-time factor. It also applies to the current period, so the time at which
  // the next step is due changes.
  void SetRealTimeFactor(double factor);

  // Starts or restarts the schedule, so that the next step is due now.
  void Restart(WallTime now);
  WallTime due() const { return due_; }
  // Records that a step starts now. Returns whether the step is late.
  bool StepStarts(WallTime now);
  std::uint64_t late_steps() const { return late_steps_; }
  void ResetLateSteps() { late_steps_ = 0; }

 private:
  base::SimTime step_;
  WallDuration period_;  // wall-clock time of one step: step_ / factor
  WallTime due_{};       // time at which the next step is due
  std::uint64_t late_steps_ = 0;
};

}  // namespace gsv::simulation
