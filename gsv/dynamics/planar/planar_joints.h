// Joints of robots that their drive alone moves, other than its wheels: a head that pans, a lift.
//
// How          A joint that is told a position goes there at its limit of velocity (without one, at
//              once) and stops; one that is told a velocity moves so. Both keep within its limits.
//              Nothing stops it, and it pushes nothing: the robot's outline stays that of its
//              joints at zero.
// Determinism  a function of the layout, the state and the step alone.
#pragma once

#include "gsv/world/state.h"

namespace gsv::dynamics {

void MovePlanarJoints(const world::Layout& layout, double seconds, world::State& state);

}  // namespace gsv::dynamics
