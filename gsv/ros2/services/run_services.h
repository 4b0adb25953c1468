// GetSimulatorFeatures, GetSimulationState, SetSimulationState, ResetSimulation and StepSimulation.
//
// The states of simulation_interfaces are phases of gsv: stopped is created, playing is starting or running, and
// paused is paused. A simulation that has ended is stopped too; only a reset leads out of that.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` outlives the host of the services.
void OfferRunServices(ServedSimulation& served);

// One of SimulationState's.
std::uint8_t StateOfPhase(simulation::Phase phase);

// Brings a simulation into a state. `code` is one of SetSimulationState's or Result's.
messages::simulation_interfaces::Result EnterState(simulation::Simulation& simulation,
                                                   std::uint8_t state);

// Takes steps and waits for them. Fails with kNotRunning unless the simulation is paused or created, and with
// kEnded when it was paused or ended before the last step, or `stops` became true.
base::Status TakeSteps(simulation::Simulation& simulation, std::uint64_t steps,
                       const std::function<bool()>& stops);

}  // namespace gsv::ros2
