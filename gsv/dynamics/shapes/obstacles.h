// Computes the obstacles for planar bodies: horizontal slices, between two heights, of static
// bodies, rigid bodies and actors.
#pragma once

#include <span>
#include <vector>

#include "gsv/dynamics/shapes/obstacle_field.h"
#include "gsv/dynamics/shapes/silhouette.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// Returns slices, between the two heights, of the collisions of all static bodies, in the order of
// the bodies, with joints at zero. A plane whose normal is within 45° of the vertical counts as
// ground and is left out. A steeper plane is an infinite wall.
std::vector<Obstacle> CollectObstacles(const world::Layout& layout, const world::State& state,
                                       Interval heights);

// Like CollectObstacles(), for `bodies`, which are rigid bodies or actors, at their present joint
// positions. Planes are omitted.
std::vector<Obstacle> CollectDynamicObstacles(const world::Layout& layout,
                                              const world::State& state,
                                              std::span<const int> bodies, Interval heights);

// The radius about the origin of a rigid body or actor that contains all its collision shapes at
// all times. Infinite for a rigid body with joints.
double DynamicRadius(const world::Body& body);

}  // namespace gsv::dynamics
