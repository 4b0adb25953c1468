// The obstacles of a world between two heights: slices of all that wheeled bases cannot push.
#pragma once

#include <span>
#include <vector>

#include "gsv/dynamics/shapes/obstacle_field.h"
#include "gsv/dynamics/shapes/silhouette.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// Slices, between the heights, of the collisions of all bodies that stand still, in the order of
// the bodies, with joints at zero. A plane whose normal is within 45° of the vertical is ground and
// left out; a steeper one is a wall without end.
std::vector<Obstacle> CollectObstacles(const world::Layout& layout, const world::State& state,
                                       Interval heights);

// The same of `bodies`, which are rigid or actors, with joints as they are. Of a plane nothing is taken.
std::vector<Obstacle> CollectLooseObstacles(const world::Layout& layout, const world::State& state,
                                            std::span<const int> bodies, Interval heights);

// No part of the rigid body or actor that anything collides with is ever farther from its origin;
// infinite where a rigid body has joints.
double LooseRadius(const world::Body& body);

}  // namespace gsv::dynamics
