// Converts names to valid ROS 2 names, and ROS 2 names to DDS names.
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

// Joins names. For example, "/pebble" and "scan" become "/pebble/scan"; "/" and "scan" become
// "/scan".
std::string InNamespace(std::string_view name_space, std::string_view name);

// Returns "rt/pebble/scan" for "/pebble/scan".
std::string DdsTopicName(std::string_view topic);
// Returns "sensor_msgs::msg::dds_::LaserScan_" for "sensor_msgs/msg/LaserScan".
std::string DdsTypeName(std::string_view type);

// Returns the ROS name of a DDS name, or an empty text if no ROS 2 name is mapped to it.
std::string RosTopicName(std::string_view dds_topic);
std::string RosTypeName(std::string_view dds_type);

}  // namespace gsv::ros2
