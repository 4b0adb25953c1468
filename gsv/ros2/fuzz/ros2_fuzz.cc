// Fuzzes the input from other participants: commands, the node graph and the USER_DATA of
// endpoints.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "gsv/messages/cdr.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/ros2/commands.h"
#include "gsv/ros2/graph.h"
#include "gsv/ros2/joint_trajectory.h"
#include "gsv/ros2/names.h"
#include "gsv/ros2/types/type_hash.h"

namespace {

const gsv::model::Model& OneJoint() {
  static const gsv::model::Model kModel = [] {
    gsv::model::Model model;
    model.joints.resize(1);
    model.joints[0].name = "joint";
    return model;
  }();
  return kModel;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gsv;
  const auto bytes = std::as_bytes(std::span(data, size));
  (void)messages::Decode<messages::geometry_msgs::Twist>(bytes);
  (void)messages::Decode<messages::geometry_msgs::TwistStamped>(bytes);
  (void)ros2::DecodeFloat64MultiArray(bytes);
  (void)ros2::DecodeGraph(bytes);
  (void)ros2::ReadJointTrajectory(bytes, OneJoint(), {0});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  (void)ros2::TypeHashIn(text);
  (void)ros2::RosTopicName(text);
  (void)ros2::RosTypeName(text);
  return 0;
}
