// Real and simulated readings of beams, at the same poses.
#pragma once

#include <vector>

#include "gsv/reality/logs/log.h"

namespace gsv::reality {

// A real scan, the reading of the simulated device at the same place, and that of a device without
// errors.
struct ScanPair {
  TimedPose pose;
  std::vector<double> real, simulated, exact;  // m; infinite: no echo
};

// Shares of beams (Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3): within `tolerance`
// of the exact range, shorter, without an echo where there should be one; and longer.
struct Mixture {
  double hit = 0, shorter = 0, none = 0, longer = 0;
};
Mixture MixtureOf(const std::vector<ScanPair>& pairs, bool of_real, double tolerance);

// Share of readings with an echo, for each beam.
std::vector<double> EchoShares(const std::vector<ScanPair>& pairs, bool of_real);

// Differences of a beam's reading from one scan to the next where the robot did not move, by the
// root of two: their deviation is that of one reading.
std::vector<double> RestDifferences(const std::vector<RangeScan>& scans);
// Returns the differences of simulated readings. Pairs must be in the order of time.
std::vector<double> RestDifferences(const std::vector<ScanPair>& pairs);

// The median distance between real and simulated ranges of each scan.
std::vector<double> MedianDifferences(const std::vector<ScanPair>& pairs);

}  // namespace gsv::reality
