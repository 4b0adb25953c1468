// The force and torque that a joint transmits, computed by inverse dynamics of the links below the
// joint.
//
// Equations  Newton-Euler equations for each link below the joint, with the velocities and mean
//            accelerations of the snapshot. Gravity and contact forces are subtracted. Motors and
//            friction of the joints below are internal forces. Motor and friction of this joint are
//            a part of the result.
// Contacts   a contact force acts on the link whose collision is nearest to the contact point.
//            Planar kinematics computes no forces between planar robots and static or planar
//            bodies, so these forces are missing.
// Left out   wind, fluids, and a joint that closes a loop of links below this joint.
// Frames     world axes.
#pragma once

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

// The force and torque that a joint transmits, in world axes.
struct JointWrench {
  geometry::Vector3 origin;         // origin of the joint
  geometry::Vector3 force, torque;  // exerted by the parent on the child: N, and N m about `origin`
};

// Returns the joint above a link, or -1.
int JointAbove(const model::Model& model, int link);

// Returns the wrench of a joint. `joint` is an index in the model of the snapshot's body.
JointWrench WrenchOf(const world::Snapshot& snapshot, int body, int joint);

}  // namespace gsv::sensing
