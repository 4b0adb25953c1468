// Converts an occupancy map to a world, and a world to a map.
#pragma once

#include <string>

#include "gsv/model/world_description.h"
#include "gsv/reality/maps/occupancy_map.h"

namespace gsv::reality {

// A world in SDFormat: the occupied cells as walls of this height (m) on a ground plane. Free and
// unknown cells stay empty. kInvalidArgument if the map has more than 200,000 boxes.
base::Result<std::string> WorldOfMap(const OccupancyMap& map, const std::string& name,
                                     double height);

struct SliceOptions {
  double resolution = 0.05;  // m
  double height = 0.2;       // m over the world's origin, where the world is cut
  double margin = 0.5;       // margin around the bodies, m
};

// The world cut at a height, as a robot that maps it finds it: the surfaces of what stands there when
// the simulation starts are occupied, and the rest is free, inside of solids too. Robots are left
// out. kInvalidArgument for a world in which nothing stands at that height, and
// for a map of more than 64 million cells.
base::Result<OccupancyMap> MapOfWorld(const model::WorldDescription& world,
                                      const SliceOptions& options);

}  // namespace gsv::reality
