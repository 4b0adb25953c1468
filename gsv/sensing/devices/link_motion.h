// The motion of each link of a body: the velocities of the snapshot, and the mean accelerations
// over the body's last step. Both include the motion of the joints.
//
// Frames  world axes.
#pragma once

#include <vector>

#include "gsv/world/snapshot.h"

namespace gsv::sensing {

// The velocities and accelerations of a link, in world axes. Units are m/s, m/s², rad/s and rad/s².
struct LinkMotion {
  geometry::Pose world_from_link;
  // `place` is a point of the link; `velocity` and `acceleration` describe the motion of this
  // point.
  geometry::Vector3 place, velocity, acceleration;
  geometry::Vector3 angular_velocity, angular_acceleration;

  // Returns the acceleration of another point of the link.
  geometry::Vector3 AccelerationOf(const geometry::Vector3& point) const;
  // Changes `place` to another point of the link, and `velocity` and `acceleration` to its motion.
  void MoveTo(const geometry::Vector3& point);
};

// Returns the motion of a link of a body.
LinkMotion MotionOfLink(const world::Snapshot& snapshot, int body, int link);
// As above, without accelerations.
LinkMotion MotionOfLink(const world::Layout& layout, const world::State& state, int body, int link);

// Returns the motions of all links in the order of the model's links.
std::vector<LinkMotion> MotionsOfLinks(const world::Snapshot& snapshot, int body);

}  // namespace gsv::sensing
