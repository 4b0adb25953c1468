// Fits a world to a log's own readings, if there is no map of the place.
#pragma once

#include "gsv/model/world_description.h"
#include "gsv/reality/logs/log.h"
#include "gsv/reality/maps/occupancy_map.h"

namespace gsv::reality {

// Blocks of four seconds, in turn: a world and a device are fitted to the scans of the even blocks
// and judged by those of the odd ones.
inline constexpr double kBlockSeconds = 4;
bool IsForFitting(double time);
// In the second half of its block.
bool IsLateInBlock(double time);

// The scans of the even blocks (`for_fitting`) or of the odd ones.
std::vector<RangeScan> ScansFor(const Log& log, bool for_fitting);

// An occupancy grid by log odds (Thrun, Burgard, Fox, "Probabilistic Robotics", chapter 9): of cones
// of sound, cells at the range are perhaps occupied, cells before it free. Scans need `base`.
// kInvalidArgument if no scan has a pose or the path is more than a kilometre wide.
base::Result<OccupancyMap> FitMap(const Log& log, const std::vector<RangeScan>& scans,
                                  double resolution);

// The map with the evidence of a laser's scans: a cell that is known to be occupied becomes free
// when beams pass through it, and a free one becomes occupied where beams end.
OccupancyMap UpdatedMap(OccupancyMap map, const Log& log, const std::vector<RangeScan>& scans);

// Walls on nothing, to be sensed only.
model::WorldDescription WallsOf(const OccupancyMap& map, double height);

}  // namespace gsv::reality
