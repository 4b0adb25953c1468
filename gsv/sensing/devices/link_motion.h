// The motion of each link of a body: velocities of the snapshot, and mean accelerations over its
// last step. They include those of joints.
//
// Frames  world axes.
#pragma once

#include <vector>

#include "gsv/world/snapshot.h"

namespace gsv::sensing {

struct LinkMotion {
  geometry::Pose world_from_link;
  // The point of the link at `place`, with its velocity and acceleration.
  geometry::Vector3 place, velocity, acceleration;
  geometry::Vector3 angular_velocity, angular_acceleration;

  geometry::Vector3 AccelerationOf(const geometry::Vector3& point) const;
};

// Returns the motions in the order of the model's links.
std::vector<LinkMotion> MotionsOfLinks(const world::Snapshot& snapshot, int body);

}  // namespace gsv::sensing
