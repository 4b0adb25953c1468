// Offers the services GetSpawnables, SpawnEntity and DeleteEntity.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` must outlive the host of the services.
void OfferSpawnServices(ServedSimulation& served);

// Removes a robot or an object. To remove an object, a running simulation is paused, and then
// resumed.
base::Status RemoveEntity(simulation::Simulation& simulation, const std::string& name);

}  // namespace gsv::ros2
