// The obstacles of a world between two heights: slices of everything that wheeled bases cannot
// push.
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

// The same for `bodies`, which are rigid bodies or actors, at their present joint positions. Planes
// are omitted.
std::vector<Obstacle> CollectLooseObstacles(const world::Layout& layout, const world::State& state,
                                            std::span<const int> bodies, Interval heights);

// The radius around the origin of a rigid body or actor that contains all its collision shapes at
// all times. It is infinite for a rigid body with joints.
double LooseRadius(const world::Body& body);

}  // namespace gsv::dynamics
