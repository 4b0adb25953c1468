// Converts between a ball joint's orientation and angular velocity, and the angles and rates of the
// three joints that form it.
//
// Frames  the child is rotated by Rot(a1, q1) Rot(a2, q2) Rot(a3, q3) in the joint's frame, where
//         a1, a2, a3 are the axes. Solvers use the product of the three rotations as a single
//         rotation, expressed in the child's part frame.
#pragma once

#include <array>

#include "gsv/dynamics/motion/articulation.h"

namespace gsv::dynamics {

// Converts between one rotation of a ball joint and the angles of its three joints in the model.
class BallAngles {
 public:
  // `part` must be the child of a ball joint.
  BallAngles(const model::Model& model, const Part& part);

  // Indices of the model's joints, from parent to child.
  const std::array<int, 3>& joints() const { return joints_; }

  // Turn() converts the joint angles to the child's rotation from the zero position, in its part
  // frame. AnglesOf() is the inverse. Every rotation has angles. They are not unique if the middle
  // angle is ±90 degrees.
  geometry::Quaternion Turn(const std::array<double, 3>& angles) const;
  // The inverse of Turn().
  std::array<double, 3> AnglesOf(const geometry::Quaternion& turn) const;

  // AngularVelocity() converts the rates (rad/s) about the joint's three axes to the child's
  // angular velocity relative to its parent, in the child's part frame. RatesOf() is the inverse.
  geometry::Vector3 AngularVelocity(const std::array<double, 3>& rates) const;
  // The inverse of AngularVelocity().
  std::array<double, 3> RatesOf(const geometry::Vector3& angular_velocity) const;

 private:
  std::array<int, 3> joints_;              // see joints()
  std::array<geometry::Vector3, 3> axes_;  // the three joint axes, in the joint's frame
  geometry::Quaternion part_from_joint_;   // from the joint's frame to the child's part frame
};

}  // namespace gsv::dynamics
