// Offers the services of simulation_interfaces for worlds and named poses.
//
// Threads  see ServiceHost.
#pragma once

#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// Offers the services for worlds and named poses. If the spawner cannot load worlds, requests to
// load or unload a world get RESULT_FEATURE_UNSUPPORTED. If there is no spawner, requests for named
// poses or available worlds also get this result.
void OfferWorldServices(ServedSimulation& served);

}  // namespace gsv::ros2
