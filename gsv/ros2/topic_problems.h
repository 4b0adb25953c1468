// Finds why publishers and subscriptions of a topic do not match.
#pragma once

#include <string>
#include <vector>

#include "gsv/ros2/dds/participant.h"

namespace gsv::ros2 {

// One sentence for each topic and cause: types or type hashes that differ, and QoS of which the
// subscription asks for more than the publisher offers. Sorted. Other topics than those of ROS 2 are skipped.
std::vector<std::string> FindTopicProblems(const std::vector<dds::Endpoint>& endpoints);

}  // namespace gsv::ros2
