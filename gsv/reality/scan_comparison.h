// Compares real and simulated readings of beams at the same poses.
#pragma once

#include <string>
#include <vector>

#include "gsv/reality/logs/log.h"

namespace gsv::reality {

// A real scan, and the simulated readings at the same pose, with and without errors of the
// device.
struct ScanPair {
  TimedPose pose;
  std::vector<double> real, simulated, exact;  // in m; infinite means no echo
};

// Fractions of beams (Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3): within
// `tolerance` of the exact range, shorter, without an echo although one is expected, and longer.
struct Mixture {
  double hit = 0, shorter = 0, none = 0, longer = 0;  // in the order of the comment above
};
Mixture MixtureOf(const std::vector<ScanPair>& pairs, bool of_real, double tolerance);

// Returns a warning if fewer than half of the readings are within `tolerance` of a surface. In this
// case the poses or the world are wrong, and the comparison says little about the device. Otherwise
// returns an empty text.
std::string WarningAbout(const Mixture& real, double tolerance);

// Returns the fraction of readings with an echo, for each beam of the real or the simulated device.
std::vector<double> EchoShares(const std::vector<ScanPair>& pairs, bool of_real);

// Returns the differences between a beam's readings in consecutive scans of a robot at rest,
// divided by the square root of two. The standard deviation of these values equals the standard
// deviation of one reading.
std::vector<double> RestDifferences(const std::vector<RangeScan>& scans);
// Returns the same differences for the simulated readings. All pairs must have the same pose,
// because this function does not check whether the robot is at rest. `pairs` must be ordered by
// time.
std::vector<double> RestDifferences(const std::vector<ScanPair>& pairs);

// Returns the median of the absolute differences between real and simulated ranges, for each scan
// in which at least one beam has both a real and a simulated echo.
std::vector<double> MedianDifferences(const std::vector<ScanPair>& pairs);

}  // namespace gsv::reality
