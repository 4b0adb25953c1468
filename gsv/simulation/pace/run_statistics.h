// Measures the real-time factor and the duration of steps.
#pragma once

#include <deque>

#include "gsv/base/sim_time.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

// The measured real-time factor and duration of steps.
class RunStatistics {
 public:
  // Record that the simulation starts or stops running.
  void Started(WallTime wall, base::SimTime time);
  void Stopped(WallTime wall, base::SimTime time);
  // Records a step, or several steps that were taken at once, which took `duration`. Call it after
  // each step. About ten samples per second are stored.
  void Stepped(WallTime wall, base::SimTime time, WallDuration duration, int steps = 1);

  // While the simulation runs: the actual real-time factor over the last second. Otherwise: the
  // real-time factor over the whole time for which the simulation ran.
  double real_time_factor() const;
  // The wall-clock time for which the simulation has run, up to the last call of Stepped() or
  // Stopped().
  WallDuration wall_time() const;
  WallDuration mean_step_time() const;

 private:
  // Simulated time at an instant of wall-clock time.
  struct Sample {
    WallTime wall;
    base::SimTime time;
  };
  bool running_ = false;       // true between Started() and Stopped()
  Sample start_{};             // the last call of Started()
  Sample latest_{};            // the last step
  std::deque<Sample> recent_;  // samples of about the last second
  // Wall-clock time for which the simulation ran before the last call of Started().
  WallDuration wall_before_{};
  WallDuration in_steps_{};  // total duration of all steps
  std::int64_t steps_ = 0;
  base::SimTime time_before_{0};  // like wall_before_, in simulated time
};

}  // namespace gsv::simulation
