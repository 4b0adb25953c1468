#include "gsv/sensing/devices/sensor_motion.h"

#include <vector>

#include "gsv/base/check.h"

namespace gsv::sensing {
namespace {

using geometry::Cross;
using geometry::Pose;
using geometry::Vector3;

// The motion of a point that is fixed in a rotating frame.
struct Frame {
  Vector3 place, velocity, acceleration;
  Vector3 angular_velocity, angular_acceleration;

  // Moves to another point of the same rigid body.
  void MoveTo(const Vector3& to) {
    const Vector3 arm = to - place;
    const Vector3 around = Cross(angular_velocity, arm);
    velocity += around;
    acceleration += Cross(angular_acceleration, arm) + Cross(angular_velocity, around);
    place = to;
  }

  // Changes from the link above a joint to the link below it. The point must be at the joint.
  // `rate` is the joint's velocity along `axis` (m/s) or about `axis` (rad/s).
  void PassJoint(const model::Joint& joint, const Vector3& axis, double rate) {
    if (joint.kind == model::JointKind::kPrismatic) {
      velocity += rate * axis;
      acceleration += 2 * rate * Cross(angular_velocity, axis);
    } else if (joint.kind == model::JointKind::kRevolute ||
               joint.kind == model::JointKind::kContinuous) {
      angular_acceleration += rate * Cross(angular_velocity, axis);
      angular_velocity += rate * axis;
    }
  }
};

// Returns the joints from the root to a link.
std::vector<int> JointsTo(const model::Model& model, int link) {
  std::vector<int> chain;
  while (link >= 0 && chain.size() < model.links.size()) {
    int parent = -1;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      if (model.joints[j].child == link) parent = static_cast<int>(j);
    }
    if (parent < 0) break;
    chain.insert(chain.begin(), parent);
    link = model.joints[parent].parent;
  }
  return chain;
}

}  // namespace

SensorMotion MotionOf(const Sampling& sampling, const model::SensorDescription& description) {
  const world::Snapshot& snapshot = *sampling.snapshot();
  const world::Body& robot = sampling.robot();
  const world::BodyState& body = snapshot.state.bodies[sampling.body()];
  Frame frame{body.world_from_model.position, body.linear_velocity, {}, body.angular_velocity, {}};
  if (!snapshot.accelerations.empty()) {
    const world::Acceleration& mean = snapshot.accelerations[sampling.body()];
    frame.acceleration = mean.linear;
    frame.angular_acceleration = mean.angular;
  }
  const model::Model& model = *robot.model;
  for (const int j : JointsTo(model, description.link)) {
    const model::Joint& joint = model.joints[j];
    const Pose world_from_joint = world::LinkPose(snapshot, sampling.body(), joint.child) *
                                  Inverse(model.links[joint.child].model_from_link) *
                                  joint.model_from_joint;
    frame.MoveTo(world_from_joint.position);
    frame.PassJoint(joint, world_from_joint.orientation * joint.axis,
                    snapshot.state.joint_velocities[robot.first_joint + j]);
  }
  const Pose world_from_sensor = sampling.WorldFromSensor(description);
  frame.MoveTo(world_from_sensor.position);
  return {world_from_sensor, frame.velocity, frame.angular_velocity, frame.acceleration};
}

}  // namespace gsv::sensing
