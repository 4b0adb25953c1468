// Places the pedestrians of a new simulation.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::simulation {

// Returns the layout with the pedestrians of all groups added, each on its route and without
// overlaps. Also passes this layout to the engine. The places depend only on the seed, the groups
// and the world. Fails with kInvalidArgument for invalid groups, and if there is not enough space
// for all pedestrians.
base::Result<std::shared_ptr<const world::Layout>> PlacePedestrians(
    const world::Layout& layout,
    const std::vector<std::shared_ptr<const model::PedestrianGroup>>& groups, std::uint64_t seed,
    dynamics::Engine& engine);

}  // namespace gsv::simulation
