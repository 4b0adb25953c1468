// A ROS 2 node: its writers and readers under one name.
//
// Threads  one; callbacks of readers run on threads of the DDS library.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"

namespace gsv::ros2 {

// The QoS profiles of the topics. They follow rmw/qos_profiles.h and the usual profiles of /clock,
// /tf, /rosout and latched topics.
inline constexpr dds::Qos kSensorDataQos{.is_reliable = false, .depth = 5};
inline constexpr dds::Qos kLargeDataQos{.is_reliable = false, .depth = 5, .is_large = true};
inline constexpr dds::Qos kDefaultQos{.depth = 10};
inline constexpr dds::Qos kLatchedQos{.is_transient_local = true, .depth = 1};
inline constexpr dds::Qos kClockQos{.depth = 1};
inline constexpr dds::Qos kTransformQos{.depth = 100};
inline constexpr dds::Qos kLogQos{.is_transient_local = true, .depth = 1000};

// One node in the message of ros_discovery_info.
struct NodeInfo {
  std::string name_space, name;
  std::vector<dds::Guid> readers, writers;  // the node's endpoints
  friend bool operator==(const NodeInfo&, const NodeInfo&) = default;
};

// The endpoints of one ROS 2 node. They exist as long as the node.
class Node {
 public:
  // `participant` must outlive the node. `on_match` is called when a reader of one of the node's
  // topics is added or removed. Endpoints contain the hashes of their types, except in Humble,
  // which has no hashes.
  Node(dds::Participant& participant, Distro distro, std::string name_space, std::string name,
       std::function<void()> on_match);

  const std::string& name_space() const { return info_.name_space; }
  const NodeInfo& info() const { return info_; }

  // `topic` is absolute or relative to the node's namespace. `type` has the form
  // "std_msgs/msg/String". The writer exists as long as the node. If the participant refuses,
  // returns null and logs the reason.
  dds::Writer* Advertise(std::string_view topic, std::string_view type, const dds::Qos& qos);
  // If the participant refuses, returns null and logs the reason.
  dds::Reader* Subscribe(std::string_view topic, std::string_view type, const dds::Qos& qos,
                         std::function<void(std::span<const std::byte>)> on_message);

 private:
  // Returns the DDS topic of a ROS topic.
  dds::Topic TopicFor(std::string_view topic, std::string_view type, const dds::Qos& qos) const;

  dds::Participant& participant_;
  const bool has_hashes_;  // whether endpoints contain the hashes of their types
  const std::function<void()> on_match_;
  NodeInfo info_;
  std::vector<std::unique_ptr<dds::Writer>> writers_;
  std::vector<std::unique_ptr<dds::Reader>> readers_;
};

}  // namespace gsv::ros2
