// The pose of an actor at a given time, according to its script.
//
// Positions     a cubic Hermite spline through the waypoints (Catmull and Rom 1974, with tension):
//               the tangent at waypoint i is (1 - tension) (p[i+1] - p[i-1]) / 2, at the ends of an
//               open trajectory (1 - tension) (p[1] - p[0]) / 2, and where the last position equals
//               the first both have the tangent of a closed curve. Between two waypoints the
//               spline's parameter grows evenly with time. So does ignition::math::Spline, which
//               Gazebo's actors follow. With a tension of 1 the way is straight, and the actor
//               stops at each waypoint.
// Orientations  spherical linear interpolation, the shorter way round. (Gazebo's is a spline as
//               well, which differs between waypoints.)
// Times         as SDFormat has it: the script waits for its delay, runs its trajectories one after
//               the other, and begins again if it loops, waiting anew. Before it has run for the
//               first time its actor stands at the first waypoint; later, at the last.
// Determinism   a function of the arguments alone.
#pragma once

#include <cstdint>

#include "gsv/model/script.h"

namespace gsv::dynamics {

struct ScriptInstant {
  geometry::Pose pose;         // trajectory_from_actor
  std::int64_t cycle = 0;      // how often the script has begun anew
  std::size_t trajectory = 0;  // the trajectory that the actor follows
  base::SimTime since{0};      // since that trajectory's start
};

// `time` is not below zero.
ScriptInstant InstantOf(const model::Script& script, base::SimTime time);

// The pose on a trajectory. Before the first waypoint it is the pose of the first one, and after
// the last waypoint that of the last one.
geometry::Pose PoseOn(const model::Trajectory& trajectory, base::SimTime time);

}  // namespace gsv::dynamics
