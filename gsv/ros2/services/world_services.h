// Offers the services of simulation_interfaces for worlds and named poses.
//
// Threads  see ServiceHost.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// Offers get_current_world and get_available_worlds. Requests to load or unload a world, or for
// named poses, get RESULT_FEATURE_UNSUPPORTED.
void OfferWorldServices(ServedSimulation& served);

}  // namespace gsv::ros2
