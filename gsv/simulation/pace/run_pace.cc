#include "gsv/simulation/pace/run_pace.h"

#include <utility>

#include <fmt/format.h>

#include "gsv/model/real_time_factor.h"

namespace gsv::simulation {

base::Status CheckRealTimeFactor(double factor, const std::string& simulation) {
  if (factor > 0 && factor <= model::kMaxRealTimeFactor) return {};
  return base::Fail(
      base::ErrorCode::kInvalidArgument,
      fmt::format("the real-time factor is {}; it must be above 0 and at most 1e6", factor),
      simulation);
}

void RunPace::SetRunning(bool is_running, base::SimTime now) {
  if (std::exchange(is_running_, is_running) == is_running) return;
  if (is_running) {
    has_resumed_ = true;
    statistics_.Started(WallNow(), now);
  } else {
    statistics_.Stopped(WallNow(), now);
  }
}

void RunPace::Reset() {
  pacer_.ResetLateSteps();
  statistics_ = RunStatistics();
}

void RunPace::SetRealTimeFactor(double factor) {
  factor_ = factor;
  pacer_.SetRealTimeFactor(factor);
}

void RunPace::RestartIfResumed() {
  if (std::exchange(has_resumed_, false)) pacer_.Restart(WallNow());
}

void RunPace::FillStatus(SimulationStatus& status) const {
  status.target_factor = factor_;
  status.real_time_factor = statistics_.real_time_factor();
  status.wall_time = statistics_.wall_time();
  status.mean_step_time = statistics_.mean_step_time();
  status.late_steps = pacer_.late_steps();
}

}  // namespace gsv::simulation
