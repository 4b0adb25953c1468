// Makes a world from a log's own readings, if there is no map of the place.
#pragma once

#include "gsv/model/world_description.h"
#include "gsv/reality/logs/log.h"
#include "gsv/reality/maps/occupancy_map.h"

namespace gsv::reality {

// A log is divided into blocks of four seconds. A world and a device are fitted to the scans of the
// even blocks, and validated with the scans of the odd blocks.
inline constexpr double kBlockSeconds = 4;
bool IsForFitting(double time);
// Whether the time is in the second half of its block.
bool IsLateInBlock(double time);

// Returns the scans of the even blocks (`for_fitting`) or of the odd ones.
std::vector<RangeScan> ScansFor(const Log& log, bool for_fitting);

// Makes an occupancy grid by log odds (Thrun, Burgard, Fox, "Probabilistic Robotics", chapter 9).
// In a cone of sound, cells at the measured range may be occupied, and nearer cells are free. Scans
// need `base`. Returns kInvalidArgument if no scan has a pose, or if the path is too wide.
base::Result<OccupancyMap> FitMap(const Log& log, const std::vector<RangeScan>& scans,
                                  double resolution);

// Returns the map updated by scans of a laser: an occupied cell becomes free if beams pass through
// it, and a free cell becomes occupied if beams end in it. A free cell that no beam touches becomes
// unknown.
OccupancyMap UpdatedMap(OccupancyMap map, const Log& log, const std::vector<RangeScan>& scans);

// Returns the walls as a world without a ground. Such a world is for sensors only.
model::WorldDescription WallsOf(const OccupancyMap& map, double height);

}  // namespace gsv::reality
