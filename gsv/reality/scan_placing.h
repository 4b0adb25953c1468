// Finds the poses of a log's scans in a given or fitted world, and simulates readings at these
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

// Returns the log. If its scans have no poses but there are wheel readings, the returned scans have
// poses that are computed from the wheel readings.
Log WithBases(Log log, const CompareOptions& options);

// Returns the scans of the log's even blocks (`for_fitting`) or of its odd blocks. Worlds are
// fitted to the even blocks, so these blocks cannot be used to judge a device. If `for_fitting` and
// the world is fitted or updated, the first half of each even block makes the world, and the second
// half is compared. Fails with kInvalidArgument if no world or no path can be found.
base::Result<PlacedScans> PlaceScans(const Log& log, const CompareOptions& options,
                                     bool for_fitting);

// Returns each scan of `placed`, together with the readings of the simulated device at the same
// pose.
base::Result<std::vector<ScanPair>> PairScans(const PlacedScans& placed, const Log& log,
                                              const CompareOptions& options);

// Returns the sensors that the options describe.
std::vector<model::SensorDescription> ConfiguredSensors(const Log& log,
                                                        const CompareOptions& options);

// Replaces readings at or beyond the maximum range, and negative ones, by infinity (no echo).
void MarkMissing(std::vector<double>& ranges, double max_range);

// Returns "sonar" or "lidar".
std::string ScannerOf(const Log& log);
// Returns the options' preset if it is for this sensor type, else an empty text. A log may have
// devices of several types, but a preset is for one type.
std::string PresetOf(const std::string& type, const CompareOptions& options);

}  // namespace gsv::reality
