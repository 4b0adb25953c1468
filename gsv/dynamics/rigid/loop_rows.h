// Constraint rows of a loop joint. A loop joint connects two parts of one tree of links, so that
// the links form a loop, as in a four-bar linkage or a scissor lift.
//
// Drift  with constraints on velocities alone, the two ends drift apart. Each substep corrects a
//        fraction of this drift (Baumgarte, "Stabilization of constraints and integrals of motion
//        in dynamical systems", 1972).
#pragma once

#include "gsv/dynamics/rigid/joint_rows.h"
#include "gsv/dynamics/rigid/link_tree.h"

namespace gsv::dynamics {

// A joint that closes a loop of links. The solver treats it as constraint rows.
class LoopJoint {
 public:
  // `kind` is fixed, revolute, continuous, prismatic or ball. `part` is an index in the
  // articulation. The joint's axis is the z axis of its frame at each end.
  struct End {
    int part = 0;                    // index of the part in the articulation
    geometry::Pose part_from_joint;  // pose of the joint's frame in the frame of the part
  };
  LoopJoint(const End& first, const End& second, model::JointKind kind)
      : first_(first), second_(second), kind_(kind) {}

  // Adds the rows for a substep of `seconds`.
  void AddRows(const LinkTree& tree, double seconds, JointRows& rows) const;

 private:
  End first_, second_;  // the joint's frame on each of the two parts that it connects
  model::JointKind kind_;
};

// The joints that close the loops of a body.
std::vector<LoopJoint> LoopJointsOf(const RigidBody& plan);

}  // namespace gsv::dynamics
