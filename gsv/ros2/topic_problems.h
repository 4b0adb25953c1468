// Finds the reasons why publishers and subscriptions of a topic do not match.
#pragma once

#include <string>
#include <vector>

#include "gsv/ros2/dds/participant.h"

namespace gsv::ros2 {

// Returns one sentence for each topic and cause, sorted. The causes are different types, different
// type hashes, and a subscription with a stricter QoS than the publisher offers. Ignores DDS topics
// that are not ROS 2 topics.
std::vector<std::string> FindTopicProblems(const std::vector<dds::Endpoint>& endpoints);

}  // namespace gsv::ros2
