// Offers the services GetEntities, GetEntityInfo, GetEntityState, GetEntitiesStates,
// GetEntityBounds, SetEntityState and SetEntityInfo.
//
// Every body of the simulation is an entity. The entity has the name of the body.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// `served` must outlive the host of the services.
void OfferEntityServices(ServedSimulation& served);

// Returns the index of an entity. Fails with kNotFound if no entity has this name. The error then
// suggests the closest name.
base::Result<int> FindEntity(const world::Snapshot& snapshot, const std::string& name);

}  // namespace gsv::ros2
