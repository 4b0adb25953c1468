#include "gsv/ros2/services/results.h"

#include <utility>

namespace gsv::ros2 {

using messages::simulation_interfaces::Result;
using simulation::Phase;

Result Succeeded() { return {Result::kResultOk, {}}; }

Result Failed(std::uint8_t code, std::string message) { return {code, std::move(message)}; }

Result ResultOf(const base::Error& error) {
  switch (error.code) {
    case base::ErrorCode::kNotFound:
      return {Result::kResultNotFound, error.Sentence()};
    case base::ErrorCode::kNotRunning:
    case base::ErrorCode::kEnded:
      return {Result::kResultIncorrectState, error.Sentence()};
    default:
      return {Result::kResultOperationFailed, error.Sentence()};
  }
}

Result ResultOf(const base::Status& status) {
  return status ? Succeeded() : ResultOf(status.error());
}

Phase PhaseOf(const simulation::Simulation& simulation) {
  return simulation.WaitForPhase(
      {Phase::kCreated, Phase::kStarting, Phase::kRunning, Phase::kPaused, Phase::kStopped,
       Phase::kFinished, Phase::kFailed},
      std::chrono::milliseconds(0));
}

base::Status EditWhilePaused(simulation::Simulation& simulation,
                             const std::function<base::Status()>& edit) {
  const Phase phase = PhaseOf(simulation);
  const bool is_running = phase == Phase::kStarting || phase == Phase::kRunning;
  if (is_running) {
    if (auto ok = simulation.Pause(); !ok) return ok;
  }
  const base::Status edited = edit();
  if (is_running) {
    if (auto ok = simulation.Resume(); !ok && edited) return ok;
  }
  return edited;
}

}  // namespace gsv::ros2
