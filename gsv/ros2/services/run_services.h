// GetSimulatorFeatures, GetSimulationState, SetSimulationState, ResetSimulation and StepSimulation.
//
// The states of simulation_interfaces correspond to phases of gsv: stopped to created, playing to
// starting or running, and paused to paused. An ended simulation is stopped until it is reset.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` must outlive the host of the services.
void OfferRunServices(ServedSimulation& served);

// Returns a constant of SimulationState.
std::uint8_t StateOfPhase(simulation::Phase phase);

// Changes the state of a simulation to `state`, a constant of SimulationState. The code of the
// result is a constant of SetSimulationState or of Result.
messages::simulation_interfaces::Result EnterState(simulation::Simulation& simulation,
                                                   std::uint8_t state);

// Takes steps and waits until they are complete. Fails with kNotRunning unless the simulation is
// paused or created. Fails with kEnded if the simulation was paused or ended before the last step,
// or if `stops` became true.
base::Status TakeSteps(simulation::Simulation& simulation, std::uint64_t steps,
                       const std::function<bool()>& stops);

}  // namespace gsv::ros2
