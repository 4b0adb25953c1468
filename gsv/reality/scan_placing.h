// Finds the poses of a log's scans in a given or fitted world, and the simulated readings at these
// poses.
#pragma once

#include <string>
#include <vector>

#include "gsv/reality/comparison.h"

namespace gsv::reality {

// The scans to compare, and their world.
struct PlacedScans {
  model::WorldDescription world;
  std::vector<RangeScan> scans;  // each scan has `base`
};

// Returns the log with the poses of its scans, if they can be computed from its wheels alone.
Log WithBases(Log log, const CompareOptions& options);

// Returns the scans of the log's even blocks (`for_fitting`) or of its odd ones. A world that is
// fitted or updated is made from the even blocks, so these cannot be used to judge the device. For
// fitting, the first half of each even block makes the world, and the second half is compared.
// Returns kInvalidArgument if no world or no path can be found.
base::Result<PlacedScans> PlaceScans(const Log& log, const CompareOptions& options,
                                     bool for_fitting);

// Returns the same scans, each with the readings of the simulated device.
base::Result<std::vector<ScanPair>> PairScans(const PlacedScans& placed, const Log& log,
                                              const CompareOptions& options);

// Returns the device that the options describe.
std::vector<model::SensorDescription> AskedSensors(const Log& log, const CompareOptions& options);

// Readings at or beyond the maximum range become infinite (no echo).
void MarkMissing(std::vector<double>& ranges, double max_range);

// Returns "sonar" or "lidar".
std::string ScannerOf(const Log& log);
// Returns the options' preset if it is of this type; else an empty text. A log may have several
// devices, but a preset is of one type.
std::string PresetOf(const std::string& type, const CompareOptions& options);

}  // namespace gsv::reality
