// A pedestrian: its desired speed and its goals.
//
// Determinism  every draw is a function of the simulation's seed, the pedestrian's stream and the
//              index of the draw. The stream follows from the pedestrian's name, so each pedestrian
//              has its own.
#pragma once

#include <cstdint>
#include <memory>

#include "gsv/geometry/vector3.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::world {

struct Pedestrian {
  std::shared_ptr<const model::PedestrianGroup> group;  // never null
  std::uint64_t seed = 0, stream = 0;                   // key of the pedestrian's random numbers
  double speed = 1.34;                                  // desired speed, m/s
  std::uint32_t leg = 0;  // index of the first leg of the group's route that this pedestrian walks
};

// Draws a pedestrian's desired speed and its first leg. The speed is from a third to twice the
// speed of the group.
Pedestrian DrawPedestrian(std::shared_ptr<const model::PedestrianGroup> group, std::uint64_t seed,
                          std::uint64_t stream);

// Returns the next goal after `reached` goals. This is a random point in the disc of the route's
// goal with the index leg + 1 + reached. After the last goal, the route begins again.
geometry::Vector2 GoalOf(const Pedestrian& pedestrian, std::uint32_t reached);

// Returns a possible start on the way to the first goal. Each value of `attempt` gives another
// start.
geometry::Vector2 StartOf(const Pedestrian& pedestrian, std::uint32_t attempt);

}  // namespace gsv::world
