#include "gsv/ros2/services/run_services.h"

#include <algorithm>

#include "gsv/base/sorting.h"
#include "gsv/ros2/services/spawn_services.h"

namespace gsv::ros2 {
namespace {

namespace interfaces = messages::simulation_interfaces;
using simulation::Phase;
using simulation::Simulation;
using Lane = ServiceHost::Lane;
using Features = interfaces::SimulatorFeatures;
using State = interfaces::SimulationState;
using SetResponse = interfaces::SetSimulationStateResponse;
using ResetRequest = interfaces::ResetSimulationRequest;

constexpr std::chrono::milliseconds kPhaseWait{100};

bool HasEnded(Phase phase) {
  return phase == Phase::kStopped || phase == Phase::kFinished || phase == Phase::kFailed;
}

interfaces::GetSimulatorFeaturesResponse GetFeatures(bool can_spawn, bool loads_worlds) {
  interfaces::GetSimulatorFeaturesResponse response;
  response.features.features = {Features::kDeleting,
                                Features::kEntityBounds,
                                Features::kEntityBoundsBox,
                                Features::kEntityCategories,
                                Features::kEntityStateGetting,
                                Features::kEntityStateSetting,
                                Features::kEntityInfoGetting,
                                Features::kSimulationReset,
                                Features::kSimulationStateGetting,
                                Features::kSimulationStateSetting,
                                Features::kSimulationStatePause,
                                Features::kStepSimulationSingle,
                                Features::kStepSimulationMultiple,
                                Features::kStepSimulationAction,
                                Features::kWorldInfoGetting};
  if (can_spawn) {
    for (const std::uint8_t each :
         {Features::kSpawning, Features::kNamedPoses, Features::kSpawnables,
          Features::kSimulationResetSpawned, Features::kAvailableWorlds}) {
      response.features.features.push_back(each);
    }
    response.features.spawn_formats = {"sdf", "urdf"};
  }
  if (loads_worlds) {
    response.features.features.push_back(Features::kWorldLoading);
    response.features.features.push_back(Features::kWorldUnloading);
  }
  base::Sort(response.features.features);
  response.features.custom_info = "gsv";
  return response;
}

interfaces::Result Changed(const base::Status& status) {
  if (status) return Succeeded();
  return Failed(SetResponse::kStateTransitionError, status.error().Sentence());
}

base::Status Play(Simulation& simulation, Phase phase) {
  return phase == Phase::kCreated ? simulation.Start() : simulation.Resume();
}

// Pauses a simulation. If the simulation has not started, it starts and pauses before its first
// step.
base::Status Hold(Simulation& simulation, Phase phase) {
  return phase == Phase::kCreated ? simulation.RunThrough(base::SimTime(0)) : simulation.Pause();
}

base::Status ResetToStart(Simulation& simulation, bool continues) {
  const Phase before = PhaseOf(simulation);
  if (auto ok = simulation.Reset(); !ok || !continues) return ok;
  if (before == Phase::kRunning || before == Phase::kStarting) return simulation.Start();
  if (before == Phase::kPaused) return Hold(simulation, Phase::kCreated);
  return {};
}

interfaces::ResetSimulationResponse Reset(ServedSimulation& served, Simulation& simulation,
                                          const ResetRequest& request) {
  constexpr std::uint8_t kTimeAndState = ResetRequest::kScopeTime | ResetRequest::kScopeState;
  const std::uint8_t scope =
      request.scope == ResetRequest::kScopeDefault ? ResetRequest::kScopeAll : request.scope;
  const bool resets = (scope & kTimeAndState) != 0;
  if (resets && (scope & kTimeAndState) != kTimeAndState) {
    return {
        Failed(interfaces::Result::kResultFeatureUnsupported,
               "time and state can only be reset together: set both SCOPE_TIME and SCOPE_STATE")};
  }
  if ((scope & ResetRequest::kScopeSpawned) != 0) {
    for (const std::string& name : std::exchange(served.spawned(), {})) {
      const base::Status removed = RemoveEntity(simulation, name);
      const bool is_gone = removed || removed.error().code == base::ErrorCode::kNotFound;
      if (!is_gone) return {ResultOf(removed)};
    }
  }
  return {resets ? ResultOf(ResetToStart(simulation, true)) : Succeeded()};
}

interfaces::StepSimulationResponse Step(const ServiceHost& host, Simulation& simulation,
                                        const interfaces::StepSimulationRequest& request) {
  return {ResultOf(TakeSteps(simulation, request.steps, [&host] { return host.is_stopping(); }))};
}

}  // namespace

std::uint8_t StateOfPhase(Phase phase) {
  switch (phase) {
    case Phase::kStarting:
    case Phase::kRunning:
      return State::kStatePlaying;
    case Phase::kPaused:
      return State::kStatePaused;
    default:
      return State::kStateStopped;
  }
}

interfaces::Result EnterState(Simulation& simulation, std::uint8_t state) {
  const Phase phase = PhaseOf(simulation);
  if (state == State::kStateQuitting) return Changed(simulation.Stop());
  if (state > State::kStateQuitting) {
    return Failed(SetResponse::kIncorrectTransition, "there is no state " + std::to_string(state));
  }
  if (HasEnded(phase)) {
    if (state == State::kStateStopped) return Changed(ResetToStart(simulation, false));
    return Failed(
        SetResponse::kIncorrectTransition,
        std::string("the simulation is ") + ToString(phase) + ". Reset it, or set STATE_STOPPED");
  }
  if (StateOfPhase(phase) == state) {
    return Failed(SetResponse::kAlreadyInTargetState, "the simulation is already in this state");
  }
  if (state == State::kStateStopped) return Changed(ResetToStart(simulation, false));
  return Changed(state == State::kStatePlaying ? Play(simulation, phase) : Hold(simulation, phase));
}

base::Status TakeSteps(Simulation& simulation, std::uint64_t steps,
                       const std::function<bool()>& stops) {
  constexpr std::uint64_t kMaxSteps = 1'000'000'000;  // as in Simulation::Step()
  const std::int64_t first = simulation.snapshot()->state.step;
  const auto count = static_cast<std::int64_t>(std::min(steps, kMaxSteps + 1));
  if (auto ok = simulation.Step(count); !ok) return ok;
  Phase phase = Phase::kStarting;
  while (phase == Phase::kStarting || phase == Phase::kRunning) {
    if (stops()) return base::Fail(base::ErrorCode::kEnded, "gsv ends");
    phase = simulation.WaitForPhase(
        {Phase::kCreated, Phase::kPaused, Phase::kStopped, Phase::kFinished, Phase::kFailed},
        kPhaseWait);
  }
  const std::int64_t taken = simulation.snapshot()->state.step - first;
  if (taken == count) return {};
  return base::Fail(base::ErrorCode::kEnded, "the simulation was " + std::string(ToString(phase)) +
                                                 " after " + std::to_string(taken) + " of " +
                                                 std::to_string(count) + " steps");
}

void OfferRunServices(ServedSimulation& served) {
  served.host.Offer<interfaces::GetSimulatorFeaturesRequest>(
      served.node + "/get_simulator_features", "simulation_interfaces/srv/GetSimulatorFeatures",
      Lane::kQuick, [&served](const interfaces::GetSimulatorFeaturesRequest&) {
        return GetFeatures(served.spawner != nullptr, served.loads_worlds());
      });
  served.host.Offer<interfaces::GetSimulationStateRequest>(
      served.node + "/get_simulation_state", "simulation_interfaces/srv/GetSimulationState",
      Lane::kQuick, [&served](const interfaces::GetSimulationStateRequest&) {
        const auto simulation = served.simulation();
        const std::uint8_t state =
            simulation == nullptr ? State::kStateNoWorld : StateOfPhase(PhaseOf(*simulation));
        return interfaces::GetSimulationStateResponse{{state}, Succeeded()};
      });
  served.host.Offer<interfaces::SetSimulationStateRequest>(
      served.node + "/set_simulation_state", "simulation_interfaces/srv/SetSimulationState",
      Lane::kSlow, [&served](const interfaces::SetSimulationStateRequest& request) {
        const auto simulation = served.simulation();
        if (simulation != nullptr) return SetResponse{EnterState(*simulation, request.state.state)};
        return SetResponse{
            Failed(SetResponse::kIncorrectTransition, served.NoSimulation().error_message)};
      });
  served.Offer<ResetRequest, interfaces::ResetSimulationResponse>(
      "reset_simulation", "ResetSimulation", Lane::kSlow,
      [&served](Simulation& simulation, const ResetRequest& request) {
        return Reset(served, simulation, request);
      });
  served.Offer<interfaces::StepSimulationRequest, interfaces::StepSimulationResponse>(
      "step_simulation", "StepSimulation", Lane::kStepping,
      [&host = served.host](Simulation& simulation,
                            const interfaces::StepSimulationRequest& request) {
        return Step(host, simulation, request);
      });
}

}  // namespace gsv::ros2
