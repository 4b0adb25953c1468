// Compares measured and simulated ranges to radio anchors.
#pragma once

#include <string>
#include <vector>

#include "gsv/reality/comparison.h"

namespace gsv::reality {

// Returns the simulated reading for each entry of log.radio, from the robot's pose according to the
// reference system to the anchor. Infinite: not received. Walls have an effect only if a world is
// given.
base::Result<std::vector<double>> SimulatedRanges(const Log& log, const CompareOptions& options);

// The errors (m) of one range relative to the reference system.
struct RadioErrors {
  int anchor = 0;
  double distance = 0;
  double real = 0, simulated = 0;
};
// The errors of one anchor ("to anchor 105"), or at some distances ("from 1 to 2 m").
struct RadioGroup {
  std::string name;
  std::vector<double> real, simulated;  // both without ranges that were not received
};
// Groups errors by anchor, then by metres of distance. Groups of less than 20 ranges are omitted.
std::vector<RadioGroup> Grouped(const std::vector<RadioErrors>& errors);

// Fits a ranging sensor, whose bias and scatter are linear in the distance, to the even blocks.
FittedDevice FitRanging(const Log& log);

}  // namespace gsv::reality
