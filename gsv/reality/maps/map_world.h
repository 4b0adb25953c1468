// Converts an occupancy map to a world, and a world to a map.
#pragma once

#include <string>

#include "gsv/model/world_description.h"
#include "gsv/reality/maps/occupancy_map.h"

namespace gsv::reality {

// Returns a world in SDFormat: the occupied cells become walls of this height (m) on a ground
// plane. Free and unknown cells stay empty. Fails with kInvalidArgument beyond 200,000 boxes.
base::Result<std::string> WorldOfMap(const OccupancyMap& map, const std::string& name,
                                     double height);

// The resolution of a map, the height at which the world is cut, and the margin of the map.
struct SliceOptions {
  double resolution = 0.05;  // m
  double height = 0.2;       // height at which the world is cut, above its origin, m
  double margin = 0.5;       // margin around the bodies, m
};

// Cuts the world at a height, as a robot would map it: the surfaces of the bodies at the start of
// the simulation are occupied. Everything else is free, including the inside of solids. Robots are
// omitted. Fails with kInvalidArgument if no body reaches that height, or if the map would exceed
// 64 million cells.
base::Result<OccupancyMap> MapOfWorld(const model::WorldDescription& world,
                                      const SliceOptions& options);

}  // namespace gsv::reality
