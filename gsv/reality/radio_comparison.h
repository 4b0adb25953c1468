// Compares measured and simulated ranges to radio anchors.
#pragma once

#include <string>
#include <vector>

#include "gsv/reality/comparison.h"

namespace gsv::reality {

// Returns the simulated reading for each entry of log.radio, from the robot's pose in the
// reference system to the anchor. Infinite means not received. Walls have an effect only if a
// world is given.
base::Result<std::vector<double>> SimulatedRanges(const Log& log, const CompareOptions& options);

// The error of one measured and one simulated range, relative to the reference system, m.
struct RadioErrors {
  int anchor = 0;                  // number of the anchor in the log
  double distance = 0;             // distance by the reference system
  double real = 0, simulated = 0;  // measured range - distance, and simulated range - distance
};
// The errors for one anchor ("to anchor 105"), or for a range of distances ("from 1 to 2 m").
struct RadioGroup {
  std::string name;
  std::vector<double> real, simulated;  // errors of the ranges that were received, m
};
// Groups errors first by anchor, then by distance (0 to 1 m, 1 to 2 m, …). Groups with fewer than
// 20 ranges are left out.
std::vector<RadioGroup> Grouped(const std::vector<RadioErrors>& errors);

// Fits the bias and the scatter of a ranging sensor to the even blocks of the log (world_fit.h).
// The bias is linear in the distance. The variance is a constant plus a part that is proportional
// to the square of the distance.
FittedDevice FitRanging(const Log& log);

}  // namespace gsv::reality
