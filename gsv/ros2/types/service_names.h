// Maps the names of ROS 2 services and action topics to DDS names.
//
// Source  design.ros2.org, "Topic and Service name mapping to DDS".
#pragma once

#include <string>
#include <string_view>

namespace gsv::ros2 {

// A DDS topic and its DDS type. The topic is for the requests or the replies of a service, or for
// an action.
struct ServiceTopic {
  std::string name;  // "rq/gsv/spawn_entityRequest"
  std::string type;  // "simulation_interfaces::srv::dds_::SpawnEntity_Request_"
  friend bool operator==(const ServiceTopic&, const ServiceTopic&) = default;
};

// Returns the request topic of a service, such as "/gsv/spawn_entity" of the type
// "simulation_interfaces/srv/SpawnEntity".
ServiceTopic RequestTopic(std::string_view service, std::string_view type);
// Returns the topic of a service's replies.
ServiceTopic ResponseTopic(std::string_view service, std::string_view type);

// Returns the names of a topic of an action, such as "/gsv/simulate_steps/_action/feedback" with
// "simulation_interfaces/action/SimulateSteps_FeedbackMessage".
ServiceTopic ActionTopic(std::string_view topic, std::string_view type);

}  // namespace gsv::ros2
