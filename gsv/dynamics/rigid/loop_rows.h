// The rows of a joint that closes a loop of links (a four-bar linkage, a scissor lift): it holds
// two parts of one tree together.
//
// Drift  what the linear velocity constraints leave open is taken back in part each substep
//        (Baumgarte, "Stabilization of constraints and integrals of motion in dynamical systems",
//        1972).
#pragma once

#include "gsv/dynamics/rigid/joint_rows.h"
#include "gsv/dynamics/rigid/link_tree.h"

namespace gsv::dynamics {

class LoopJoint {
 public:
  // `kind` is fixed, revolute, continuous, prismatic or ball. Parts as in the articulation. The z
  // axis of the joint's frames is its axis.
  struct End {
    int part = 0;
    geometry::Pose part_from_joint;
  };
  LoopJoint(const End& first, const End& second, model::JointKind kind)
      : first_(first), second_(second), kind_(kind) {}

  // Adds the rows for a substep of `seconds`.
  void AddRows(const LinkTree& tree, double seconds, JointRows& rows) const;

 private:
  End first_, second_;
  model::JointKind kind_;
};

// The joints that close the loops of a body.
std::vector<LoopJoint> LoopJointsOf(const RigidBody& plan);

}  // namespace gsv::dynamics
