// GetSpawnables, SpawnEntity and DeleteEntity.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` outlives the host of the services.
void OfferSpawnServices(ServedSimulation& served);

// Removes a robot or an object. The simulation is paused meanwhile if it has to be.
base::Status RemoveEntity(simulation::Simulation& simulation, const std::string& name);

}  // namespace gsv::ros2
