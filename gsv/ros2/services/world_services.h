// The services of simulation_interfaces for worlds and named poses.
//
// Threads  as ServiceHost.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// get_current_world and get_available_worlds answer. Loading and unloading a world, and named poses, are answered
// with RESULT_FEATURE_UNSUPPORTED.
void OfferWorldServices(ServedSimulation& served);

}  // namespace gsv::ros2
