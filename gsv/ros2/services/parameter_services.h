// The parameter services of a node. The only parameter is use_sim_time, which ROS 2 expects of each
// node. It is true and cannot be set, because gsv's time is the simulated time.
//
// Source  rcl_interfaces of Jazzy.
#pragma once

#include "gsv/ros2/services/service_host.h"

namespace gsv::ros2 {

// `node` is a name such as "/gsv".
void OfferParameterServices(ServiceHost& host, const std::string& node);

}  // namespace gsv::ros2
