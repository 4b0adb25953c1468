// Offers the services GetSpawnables, SpawnEntity and DeleteEntity.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` must outlive the host of the services.
void OfferSpawnServices(ServedSimulation& served);

// Removes a robot or an object. Pauses a running simulation for the removal, and resumes it.
base::Status RemoveEntity(simulation::Simulation& simulation, const std::string& name);

}  // namespace gsv::ros2
