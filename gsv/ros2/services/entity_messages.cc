#include "gsv/ros2/services/entity_messages.h"

#include <cmath>

#include "gsv/messages/time.h"

namespace gsv::ros2 {
namespace {

messages::geometry_msgs::Vector3 VectorOf(const geometry::Vector3& v) { return {v.x, v.y, v.z}; }

}  // namespace

messages::geometry_msgs::Pose MessageOf(const geometry::Pose& pose) {
  return {{pose.position.x, pose.position.y, pose.position.z},
          {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w}};
}

messages::simulation_interfaces::EntityState StateOf(const world::Snapshot& snapshot, int body) {
  const auto index = static_cast<std::size_t>(body);
  const world::BodyState& state = snapshot.state.bodies[index];
  messages::simulation_interfaces::EntityState message;
  message.header.stamp = messages::ToMessage(snapshot.state.time);
  message.header.frame_id = kEntityFrame;
  message.pose = MessageOf(state.world_from_model);
  message.twist = {VectorOf(state.linear_velocity), VectorOf(state.angular_velocity)};
  if (index < snapshot.accelerations.size()) {
    const world::Acceleration& acceleration = snapshot.accelerations[index];
    message.acceleration = {VectorOf(acceleration.linear), VectorOf(acceleration.angular)};
  }
  return message;
}

messages::simulation_interfaces::Bounds BoxOf(const geometry::Bounds& bounds) {
  messages::simulation_interfaces::Bounds message;
  message.type = messages::simulation_interfaces::Bounds::kTypeBox;
  message.points = {VectorOf(bounds.max), VectorOf(bounds.min)};
  return message;
}

base::Result<geometry::Pose> PoseIn(const std::string& frame,
                                    const messages::geometry_msgs::Pose& message) {
  constexpr double kTolerance = 0.01;
  const auto wrong = [](std::string why) {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(why));
  };
  if (!frame.empty() && frame != kEntityFrame) {
    return wrong("the pose must be in the frame world, found '" + frame.substr(0, 100) + "'");
  }
  const auto& p = message.position;
  const auto& q = message.orientation;
  geometry::Pose pose{{p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}};
  if (!geometry::IsFinite(pose)) return wrong("the pose is not finite");
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (length > 0 && std::abs(length - 1) > kTolerance) {
    return wrong("the orientation must be a unit quaternion, found one of length " +
                 std::to_string(length));
  }
  pose.orientation = geometry::Normalized(pose.orientation);
  return pose;
}

bool StandsOnTheFloor(const geometry::Pose& pose) {
  return pose.position.z == 0 && pose.orientation.x == 0 && pose.orientation.y == 0;
}

}  // namespace gsv::ros2
