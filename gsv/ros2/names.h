// Names in ROS 2, and the corresponding names in DDS.
//
// Source  design.ros2.org, "Topic and Service name mapping to DDS"; REP-105 for frames.
#pragma once

#include <string>
#include <string_view>

namespace gsv::ros2 {

// Replaces each character that is not allowed in a ROS name by '_'. Letters, digits and underscores
// are allowed, and the first character is not a digit. The result is never empty.
std::string RosName(std::string_view text);

// Whether the text is an absolute namespace such as "/" or "/a/b": valid names without a slash at
// the end.
bool IsNamespace(std::string_view text);

// "/pebble" and "scan" give "/pebble/scan"; "/" and "scan" give "/scan".
std::string InNamespace(std::string_view name_space, std::string_view name);

// "/pebble/scan" is "rt/pebble/scan".
std::string DdsTopicName(std::string_view topic);
// "sensor_msgs/msg/LaserScan" is "sensor_msgs::msg::dds_::LaserScan_".
std::string DdsTypeName(std::string_view type);

// The reverse. Empty if the name is not that of a topic, or of a message type, of ROS 2.
std::string RosTopicName(std::string_view dds_topic);
std::string RosTypeName(std::string_view dds_type);

}  // namespace gsv::ros2
