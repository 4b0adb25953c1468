// Keeps the real-time schedule of a run, and measures its real-time factor.
//
// Threads  one call at a time.
#pragma once

#include <string>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/simulation/pace/pacer.h"
#include "gsv/simulation/pace/run_statistics.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

// Fails for a target real-time factor that is not in (0, 1e6]. The error names `simulation`.
base::Status CheckRealTimeFactor(double factor, const std::string& simulation);

// The real-time schedule and the measured real-time factor of a run.
class RunPace {
 public:
  RunPace(base::SimTime step, double factor) : pacer_(step, factor), factor_(factor) {}

  // Records that the simulation starts or stops running.
  void SetRunning(bool is_running, base::SimTime now);
  // Clears all statistics. The target real-time factor stays.
  void Reset();

  double target_real_time_factor() const { return factor_; }
  void SetRealTimeFactor(double factor);

  // Restarts the schedule if the run has started or resumed since the last call. The next step is
  // then due now. The stepping thread calls this before each step.
  void RestartIfResumed();
  // The time at which the next step is due.
  WallTime due() const { return pacer_.due(); }
  void StepStarts(WallTime start) { (void)pacer_.StepStarts(start); }
  void StepEnds(WallTime start, WallTime end, base::SimTime now, int steps = 1) {
    statistics_.Stepped(end, now, end - start, steps);
  }

  // Sets those members of `status` that concern wall-clock time.
  void FillStatus(SimulationStatus& status) const;

 private:
  Pacer pacer_;
  double factor_;  // target real-time factor
  RunStatistics statistics_;
  bool is_running_ = false;
  bool has_resumed_ = false;  // whether the run has started or resumed since RestartIfResumed()
};

}  // namespace gsv::simulation
