// Converts between a ball joint's orientation and angular velocity, and the angles and rates of the
// three joints that form it.
//
// Frames  the child is rotated by Rot(a1, q1) Rot(a2, q2) Rot(a3, q3) in the joint's frame, where
//         a1, a2, a3 are the axes. Solvers use this as one rotation in the child's part frame.
#pragma once

#include <array>

#include "gsv/dynamics/motion/articulation.h"

namespace gsv::dynamics {

class BallAngles {
 public:
  // For a part on a ball joint.
  BallAngles(const model::Model& model, const Part& part);

  // Indices of the model's joints, from parent to child.
  const std::array<int, 3>& joints() const { return joints_; }

  // Converts the angles to the child's rotation from the zero position, in its part frame; and
  // back. Every rotation has angles. If the middle angle is ±90 degrees, they are not unique.
  geometry::Quaternion Turn(const std::array<double, 3>& angles) const;
  std::array<double, 3> AnglesOf(const geometry::Quaternion& turn) const;

  // Converts the rates (rad/s) about the joint's three axes to the child's angular velocity
  // relative to its parent, in the child's part frame; and back.
  geometry::Vector3 AngularVelocity(const std::array<double, 3>& rates) const;
  std::array<double, 3> RatesOf(const geometry::Vector3& angular_velocity) const;

 private:
  std::array<int, 3> joints_;
  std::array<geometry::Vector3, 3> axes_;  // in the joint's frame
  geometry::Quaternion part_from_joint_;
};

}  // namespace gsv::dynamics
