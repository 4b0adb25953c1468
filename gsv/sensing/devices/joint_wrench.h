// The force and torque that a joint transmits, by inverse dynamics of what hangs from it.
//
// Equations  Newton and Euler's for each link below the joint, with the velocities of the snapshot
//            and its mean accelerations; less gravity and the forces of contacts. Motors and
//            friction of joints are internal forces of the links, or a part of the result.
// Contacts   a contact acts on the link with the collision that is nearest to its point. Planar
//            kinematics computes no contact forces: those of a planar robot are missing.
// Left out   wind, fluids, and the joint that closes a loop below this joint.
// Frames     world axes.
#pragma once

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

struct JointWrench {
  geometry::Vector3 origin;         // of the joint
  geometry::Vector3 force, torque;  // N and N m about the origin, of the parent on the child
};

// The joint above a link, or -1.
int JointAbove(const model::Model& model, int link);

// `joint` is an index in the model of the snapshot's body.
JointWrench WrenchOf(const world::Snapshot& snapshot, int body, int joint);

}  // namespace gsv::sensing
