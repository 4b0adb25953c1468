// Finds places for the pedestrians of a new simulation.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::simulation {

// The layout with the members of all groups, each somewhere on its route where it overlaps nobody
// and nothing. The engine has been given that layout. Where each starts is a function of the seed,
// the groups and the world. Refuses (kInvalidArgument) groups that make no sense, or for whose
// members there is no room.
base::Result<std::shared_ptr<const world::Layout>> PlacePedestrians(
    const world::Layout& layout,
    const std::vector<std::shared_ptr<const model::PedestrianGroup>>& groups, std::uint64_t seed,
    dynamics::Engine& engine);

}  // namespace gsv::simulation
