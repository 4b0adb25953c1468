// Names as ROS 2 has them, and what becomes of them on the wire.
//
// Source  design.ros2.org, "Topic and Service name mapping to DDS"; REP-105 for frames.
#pragma once

#include <string>
#include <string_view>

namespace gsv::ros2 {

// The text with each character that a ROS name cannot have as '_': letters, digits and underscores are left,
// and the first is no digit. Never empty.
std::string RosName(std::string_view text);

// Whether it is "/" or "/a/b": absolute, of valid names, without a slash at its end.
bool IsNamespace(std::string_view text);

// "/pebble" and "scan" give "/pebble/scan"; "/" and "scan" give "/scan".
std::string InNamespace(std::string_view name_space, std::string_view name);

// "/pebble/scan" is "rt/pebble/scan".
std::string DdsTopicName(std::string_view topic);
// "sensor_msgs/msg/LaserScan" is "sensor_msgs::msg::dds_::LaserScan_".
std::string DdsTypeName(std::string_view type);

// The other way; empty where it is no topic, or no message type, of ROS 2.
std::string RosTopicName(std::string_view dds_topic);
std::string RosTypeName(std::string_view dds_type);

}  // namespace gsv::ros2
