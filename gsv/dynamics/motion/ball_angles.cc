#include "gsv/dynamics/motion/ball_angles.h"

namespace gsv::dynamics {

using geometry::Quaternion;
using geometry::Vector3;

BallAngles::BallAngles(const model::Model& model, const Part& part)
    : joints_(JointsOfBall(model, part)),
      part_from_joint_(Inverse(part.model_from_part.orientation) *
                       model.joints[part.joint].model_from_joint.orientation) {
  for (std::size_t i = 0; i < 3; ++i) axes_[i] = model.joints[joints_[i]].axis;
}

Quaternion BallAngles::Turn(const std::array<double, 3>& angles) const {
  Quaternion turn;
  for (std::size_t i = 0; i < 3; ++i) turn = turn * geometry::FromAxisAngle(axes_[i], angles[i]);
  return geometry::Normalized(part_from_joint_ * turn * Inverse(part_from_joint_));
}

std::array<double, 3> BallAngles::AnglesOf(const Quaternion& turn) const {
  const Quaternion q = Inverse(part_from_joint_) * turn * part_from_joint_;
  const Vector3 v{q.x, q.y, q.z};
  // With the axes renamed so that the first is z, the second y and the third x, the three angles
  // are yaw, pitch and roll.
  const auto angles =
      geometry::ToRollPitchYaw({q.w, Dot(v, axes_[2]), Dot(v, axes_[1]), Dot(v, axes_[0])});
  return {angles.yaw, angles.pitch, angles.roll};
}

Vector3 BallAngles::AngularVelocity(const std::array<double, 3>& rates) const {
  return part_from_joint_ * (rates[0] * axes_[0] + rates[1] * axes_[1] + rates[2] * axes_[2]);
}

std::array<double, 3> BallAngles::RatesOf(const Vector3& angular_velocity) const {
  const Vector3 in_joint = Inverse(part_from_joint_) * angular_velocity;
  return {Dot(in_joint, axes_[0]), Dot(in_joint, axes_[1]), Dot(in_joint, axes_[2])};
}

}  // namespace gsv::dynamics
