// The obstacles of a world between two heights: slices of all that wheeled bases cannot push.
#pragma once

#include <vector>

#include "gsv/dynamics/obstacle_field.h"
#include "gsv/dynamics/silhouette.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// Whether the body moves by commands; all others stand still where the state has them.
bool IsDriven(const world::Body& body);

// Slices, between the heights, of the collisions of all bodies that are not driven, in the order of
// the bodies, with joints at zero. A plane whose normal is within 45° of the vertical is ground and
// left out; a steeper one is a wall without end.
std::vector<Obstacle> CollectObstacles(const world::Layout& layout, const world::State& state,
                                       Interval heights);

}  // namespace gsv::dynamics
