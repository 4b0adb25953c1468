// The names that ROS 2 services, and the topics of actions, have in DDS.
//
// Source  design.ros2.org, "Topic and Service name mapping to DDS".
#pragma once

#include <string>
#include <string_view>

namespace gsv::ros2 {

// Topic and type of one direction of a service, or of a topic.
struct ServiceTopic {
  std::string name;  // "rq/gsv/spawn_entityRequest"
  std::string type;  // "simulation_interfaces::srv::dds_::SpawnEntity_Request_"
  friend bool operator==(const ServiceTopic&, const ServiceTopic&) = default;
};

// `service` is "/gsv/spawn_entity", `type` is "simulation_interfaces/srv/SpawnEntity".
ServiceTopic RequestTopic(std::string_view service, std::string_view type);
ServiceTopic ResponseTopic(std::string_view service, std::string_view type);

// A topic of an action: "/gsv/simulate_steps/_action/feedback" and
// "simulation_interfaces/action/SimulateSteps_FeedbackMessage".
ServiceTopic ActionTopic(std::string_view topic, std::string_view type);

}  // namespace gsv::ros2
