// Measures the wall-clock time of each part of a step. The parts do not overlap and have no gaps.
//
// Threads  the stepping thread.
#pragma once

#include <string>
#include <utility>

#include "gsv/simulation/observer.h"
#include "gsv/simulation/pace/wall_clock.h"

namespace gsv::simulation {

// Measures the parts of each step.
class StepTimer {
 public:
  // A member of StepTimes, such as &StepTimes::bodies.
  using Part = std::chrono::nanoseconds StepTimes::*;

  // Ignores the time since the end of the last step. Call this after a pause.
  void Interrupt() { ended_ = WallTime(); }
  // Declares that `idle` of the time since the last step was spent waiting until this step was due.
  void AddIdle(WallDuration idle) { idle_ += idle; }
  // Begins to measure a step. `held_up_by` is explained at StepTimes.
  void Begin(WallTime start, std::string held_up_by) {
    times_ = {};
    if (ended_ != WallTime()) {
      times_.idle = idle_;
      times_.behaviours = start - ended_ - idle_;
      times_.held_up_by = std::move(held_up_by);
    }
    idle_ = {};
    mark_ = start;
  }
  // Adds the time since the last call, or since Begin(), to the time of a part.
  void Mark(Part part, WallTime now = WallNow()) {
    times_.*part += now - mark_;
    mark_ = now;
  }
  // Ends the step and returns its times.
  const StepTimes& End(std::int64_t step, SimTime time) {
    times_.step = step;
    times_.time = time;
    ended_ = mark_;
    return times_;
  }

 private:
  // End of the last step (WallTime() after Interrupt()), and time of the last Mark().
  WallTime ended_{}, mark_{};
  WallDuration idle_{};  // the sum of AddIdle() since the last step
  StepTimes times_;      // the times of the current step
};

}  // namespace gsv::simulation
