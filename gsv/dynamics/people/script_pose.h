// The pose of an actor at a given time, according to its script.
//
// Positions     follow a cubic Hermite spline through the waypoints (Catmull and Rom 1974, with
//               tension). The tangent at waypoint i is (1 - tension) (p[i+1] - p[i-1]) / 2. At the
//               ends of an open trajectory it is (1 - tension) (p[1] - p[0]) / 2. If the last
//               position equals the first, both have the tangent of a closed curve. Between two
//               waypoints, the spline's parameter is proportional to time. This is the spline of
//               ignition::math::Spline, which Gazebo's actors use. With a tension of 1 the path is
//               straight, and the actor stops at each waypoint.
// Orientations  are interpolated spherically (slerp), by the smaller rotation. Gazebo interpolates
//               orientations by a spline, so its orientations differ between waypoints.
// Times         follow SDFormat: the script waits for its delay, then runs its trajectories one
//               after the other. If it loops, it starts again, including the delay. Before the
//               first run, the actor is at its first waypoint. During later delays, it is at its
//               last waypoint.
// Determinism   a function of the arguments only.
#pragma once

#include <cstdint>

#include "gsv/model/script.h"

namespace gsv::dynamics {

// The state of a script at one instant: which trajectory runs, and since when.
struct ScriptInstant {
  geometry::Pose pose;         // trajectory_from_actor
  std::int64_t cycle = 0;      // number of times that the script has restarted
  std::size_t trajectory = 0;  // the trajectory that the actor follows
  base::SimTime since{0};      // time since that trajectory's start
};

// Returns the state of the script at `time`, which must not be negative.
ScriptInstant InstantOf(const model::Script& script, base::SimTime time);

// Returns the pose on a trajectory at `time`. Before the first waypoint, this is the pose of the
// first waypoint; after the last waypoint, it is the pose of the last waypoint.
geometry::Pose PoseOn(const model::Trajectory& trajectory, base::SimTime time);

}  // namespace gsv::dynamics
