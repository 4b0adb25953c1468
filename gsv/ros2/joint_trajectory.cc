#include "gsv/ros2/joint_trajectory.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gsv/messages/cdr.h"
#include "gsv/messages/time.h"
#include "gsv/messages/trajectory_msgs.h"

namespace gsv::ros2 {
namespace {

using Message = messages::trajectory_msgs::JointTrajectory;
using MessagePoint = messages::trajectory_msgs::JointTrajectoryPoint;

base::Failure<base::Error> RefuseTrajectory(std::string why) {
  return base::Fail(base::ErrorCode::kInvalidArgument, std::move(why));
}

bool AreFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

base::Result<std::vector<int>> JointsOf(const Message& message, const model::Model& model,
                                        const std::vector<int>& joints) {
  std::vector<int> found;
  for (const std::string& name : message.joint_names) {
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](int j) {
      return model.joints[static_cast<std::size_t>(j)].name == name;
    });
    if (joint == joints.end()) {
      return RefuseTrajectory("the robot has no joint '" + name.substr(0, 100) +
                              "' that takes commands");
    }
    if (std::find(found.begin(), found.end(), *joint) != found.end()) {
      return RefuseTrajectory("joint '" + name + "' is named twice");
    }
    found.push_back(*joint);
  }
  if (found.empty()) return RefuseTrajectory("it names no joints");
  return found;
}

base::Result<JointTrajectory::Point> PointOf(MessagePoint& message, std::size_t joints) {
  if (message.positions.size() != joints) {
    return RefuseTrajectory(fmt::format("a point needs {} positions, one for each joint, found {}",
                                        joints, message.positions.size()));
  }
  if (!message.velocities.empty() && message.velocities.size() != joints) {
    return RefuseTrajectory(fmt::format("a point needs {} velocities or none, found {}", joints,
                                        message.velocities.size()));
  }
  if (!AreFinite(message.positions) || !AreFinite(message.velocities)) {
    return RefuseTrajectory("positions and velocities must be finite, found NaN or infinity");
  }
  const base::SimTime time = std::chrono::seconds(message.time_from_start.sec) +
                             std::chrono::nanoseconds(message.time_from_start.nanosec);
  return JointTrajectory::Point{time, std::move(message.positions), std::move(message.velocities)};
}

// Returns the value of the cubic Hermite polynomial with these values and slopes at both ends, for
// `s` from 0 to 1.
double Cubic(double s, double length, double p0, double v0, double p1, double v1) {
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * p0 + (s3 - 2 * s2 + s) * length * v0 + (3 * s2 - 2 * s3) * p1 +
         (s3 - s2) * length * v1;
}

}  // namespace

std::vector<double> JointTrajectory::PositionsAt(base::SimTime time,
                                                 const std::vector<double>& initial) const {
  const auto next = std::find_if(points.begin(), points.end(),
                                 [&](const Point& point) { return point.time > time; });
  if (next == points.end()) return points.empty() ? initial : points.back().positions;
  // The trajectory starts at rest, regardless of the joints' earlier motion.
  const Point at_start{base::SimTime(0), initial, std::vector<double>(initial.size(), 0.0)};
  const Point& last = next == points.begin() ? at_start : *(next - 1);
  const double length = base::ToSeconds(next->time - last.time);
  const double s = length > 0 ? base::ToSeconds(time - last.time) / length : 1;
  const bool is_cubic = !next->velocities.empty() && !last.velocities.empty();
  std::vector<double> positions(initial.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = is_cubic ? Cubic(s, length, last.positions[i], last.velocities[i],
                                    next->positions[i], next->velocities[i])
                            : last.positions[i] + s * (next->positions[i] - last.positions[i]);
  }
  return positions;
}

base::Result<JointTrajectory> ReadJointTrajectory(std::span<const std::byte> sample,
                                                  const model::Model& model,
                                                  const std::vector<int>& joints) {
  auto message = messages::Decode<Message>(sample);
  if (!message) return base::Fail(message.error());
  auto found = JointsOf(*message, model, joints);
  if (!found) return base::Fail(found.error());
  if (message->points.size() > JointTrajectory::kMaxPoints) {
    return RefuseTrajectory(fmt::format("at most {} points, found {}", JointTrajectory::kMaxPoints,
                                        message->points.size()));
  }
  JointTrajectory trajectory;
  trajectory.joints = *std::move(found);
  const base::SimTime stamp = messages::ToSimTime(message->header.stamp);
  if (stamp != base::SimTime(0)) trajectory.start = stamp;
  for (MessagePoint& each : message->points) {
    auto point = PointOf(each, trajectory.joints.size());
    if (!point) return base::Fail(point.error());
    const bool is_later = trajectory.points.empty() ? point->time >= base::SimTime(0)
                                                    : point->time > trajectory.points.back().time;
    if (!is_later) return RefuseTrajectory("time_from_start must increase from point to point");
    trajectory.points.push_back(*std::move(point));
  }
  return trajectory;
}

}  // namespace gsv::ros2
