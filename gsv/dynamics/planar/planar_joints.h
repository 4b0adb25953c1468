// Moves the joints of planar robots that do not belong to the drive (wheels and steering), for
// example the joints of a lift or a pan-tilt head.
//
// How          A joint with a position command moves to this position at its velocity limit and
//              stops. Without a velocity limit, it is at the position at once. A joint with a
//              velocity command moves at this velocity. Both stay within the joint's limits.
//              Obstacles do not stop a joint, and a joint pushes nothing: the robot's footprint
//              always has all joints at zero. A mimic joint is at the position that follows from
//              its leader, which may be a wheel.
// Determinism  a function of only the layout, the state and the step.
#pragma once

#include "gsv/world/state.h"

namespace gsv::dynamics {

// Moves the commanded joints and the mimic joints of all planar robots by one step.
void MovePlanarJoints(const world::Layout& layout, double seconds, world::State& state);

}  // namespace gsv::dynamics
