// Compares real and simulated readings of beams at the same poses.
#pragma once

#include <string>
#include <vector>

#include "gsv/reality/logs/log.h"

namespace gsv::reality {

// A real scan, and the readings at the same pose of the simulated device and of a device without
// errors.
struct ScanPair {
  TimedPose pose;
  std::vector<double> real, simulated, exact;  // in m; infinite: no echo
};

// Fractions of beams (Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3): within
// `tolerance` of the exact range, shorter, without an expected echo, and longer.
struct Mixture {
  double hit = 0, shorter = 0, none = 0, longer = 0;
};
Mixture MixtureOf(const std::vector<ScanPair>& pairs, bool of_real, double tolerance);

// Returns a sentence if fewer than half of the readings are within `tolerance` of a surface: then
// the poses or the world are wrong, and the device cannot be judged. Empty otherwise.
std::string DoubtAbout(const Mixture& real, double tolerance);

// Returns the fraction of readings with an echo, for each beam.
std::vector<double> EchoShares(const std::vector<ScanPair>& pairs, bool of_real);

// Returns the differences between a beam's readings in consecutive scans of a robot at rest,
// divided by the square root of two. Their standard deviation is that of a single reading.
std::vector<double> RestDifferences(const std::vector<RangeScan>& scans);
// Returns the differences of simulated readings. Pairs must be in the order of time.
std::vector<double> RestDifferences(const std::vector<ScanPair>& pairs);

// Returns the median difference between real and simulated ranges of each scan.
std::vector<double> MedianDifferences(const std::vector<ScanPair>& pairs);

}  // namespace gsv::reality
