// Measures the real-time factor and the duration of steps.
#pragma once

#include <deque>

#include "gsv/base/sim_time.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

class RunStatistics {
 public:
  void Started(WallTime wall, base::SimTime time);
  void Stopped(WallTime wall, base::SimTime time);
  // Records a step, which took `duration`. Call it after each step. It keeps about ten samples per
  // second.
  void Stepped(WallTime wall, base::SimTime time, WallDuration duration);

  // The actual real-time factor: over the last second while the simulation runs, else over its
  // whole running time.
  double real_time_factor() const;
  // The wall-clock time spent running, up to the last call.
  WallDuration wall_time() const;
  WallDuration mean_step_time() const;

 private:
  struct Sample {
    WallTime wall;
    base::SimTime time;
  };
  bool running_ = false;
  Sample start_{};
  Sample latest_{};
  std::deque<Sample> recent_;
  WallDuration wall_before_{};
  WallDuration in_steps_{};
  std::int64_t steps_ = 0;
  base::SimTime time_before_{0};
};

}  // namespace gsv::simulation
