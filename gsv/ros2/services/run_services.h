// GetSimulatorFeatures, GetSimulationState, SetSimulationState, ResetSimulation and StepSimulation.
//
// The states of simulation_interfaces are phases of gsv: stopped is created, playing is starting or
// running, and paused is paused. After its end a simulation is stopped until a reset.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` must outlive the host of the services.
void OfferRunServices(ServedSimulation& served);

// Returns a constant of SimulationState.
std::uint8_t StateOfPhase(simulation::Phase phase);

// Brings a simulation into a state. `code` is a constant of SetSimulationState or of Result.
messages::simulation_interfaces::Result EnterState(simulation::Simulation& simulation,
                                                   std::uint8_t state);

// Takes steps and waits for them. Fails with kNotRunning unless it is paused or created, and with
// kEnded if it was paused or ended before the last step, or if `stops` became true.
base::Status TakeSteps(simulation::Simulation& simulation, std::uint64_t steps,
                       const std::function<bool()>& stops);

}  // namespace gsv::ros2
