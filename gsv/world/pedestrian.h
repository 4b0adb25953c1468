// A pedestrian: its desired speed, and the goals that it walks to.
//
// Determinism  every draw is a function of the simulation's seed, the pedestrian's own stream (its
//              name) and a number; no two share a stream.
#pragma once

#include <cstdint>
#include <memory>

#include "gsv/geometry/vector3.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::world {

struct Pedestrian {
  std::shared_ptr<const model::PedestrianGroup> group;  // never null
  std::uint64_t seed = 0, stream = 0;
  double speed = 1.34;    // m/s: that it wants to walk at
  std::uint32_t leg = 0;  // of the group's route, that it starts on
};

// Draws a member's desired speed, between a third of the group's and twice it, and its first leg.
Pedestrian DrawPedestrian(std::shared_ptr<const model::PedestrianGroup> group, std::uint64_t seed,
                          std::uint64_t stream);

// The place that it walks to after it has reached so many: within the disc of goal leg + 1 +
// reached of the route.
geometry::Vector2 GoalOf(const Pedestrian& pedestrian, std::uint32_t reached);

// Where it may start: on the way to its first goal. Attempts are numbered from 0, each elsewhere.
geometry::Vector2 StartOf(const Pedestrian& pedestrian, std::uint32_t attempt);

}  // namespace gsv::world
