#include "gsv/reality/scan_comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gsv/reality/statistics.h"

namespace gsv::reality {
namespace {

bool IsAtRest(const TimedPose& before, const TimedPose& after) {
  return std::hypot(after.x - before.x, after.y - before.y) < 1e-4 &&
         std::abs(WrappedAngle(after.yaw - before.yaw)) < 1e-4;
}

// If the range changes by more than this, the beam hits another surface.
constexpr double kSameSurface = 0.1;  // m

void AddDifferences(const std::vector<double>& before, const std::vector<double>& after,
                    std::vector<double>& differences) {
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    const double difference = after[i] - before[i];
    if (std::abs(difference) < kSameSurface) differences.push_back(difference / std::sqrt(2));
  }
}

}  // namespace

Mixture MixtureOf(const std::vector<ScanPair>& pairs, bool of_real, double tolerance) {
  Mixture mixture;
  double count = 0;
  for (const ScanPair& pair : pairs) {
    const std::vector<double>& read = of_real ? pair.real : pair.simulated;
    for (std::size_t i = 0; i < std::min(read.size(), pair.exact.size()); ++i) {
      if (!std::isfinite(pair.exact[i])) continue;
      ++count;
      if (!std::isfinite(read[i])) {
        ++mixture.none;
      } else if (std::abs(read[i] - pair.exact[i]) <= tolerance) {
        ++mixture.hit;
      } else {
        ++(read[i] < pair.exact[i] ? mixture.shorter : mixture.longer);
      }
    }
  }
  if (count == 0) return mixture;
  return {mixture.hit / count, mixture.shorter / count, mixture.none / count,
          mixture.longer / count};
}

std::string WarningAbout(const Mixture& real, double tolerance) {
  if (real.hit >= 0.5) return "";
  return fmt::format(
      "only {:.0f} % of the readings are within {} m of a surface of the world, so the values say "
      "little about the "
      "device. Give a map of the place with --world, or a log with poses of a reference system, "
      "and check "
      "--mount-forward",
      100 * real.hit, tolerance);
}

std::vector<double> EchoShares(const std::vector<ScanPair>& pairs, bool of_real) {
  std::vector<double> shares;
  for (const ScanPair& pair : pairs) {
    const std::vector<double>& read = of_real ? pair.real : pair.simulated;
    shares.resize(std::max(shares.size(), read.size()));
    for (std::size_t i = 0; i < read.size(); ++i) shares[i] += std::isfinite(read[i]) ? 1 : 0;
  }
  for (double& share : shares) share /= static_cast<double>(pairs.size());
  return shares;
}

std::vector<double> RestDifferences(const std::vector<RangeScan>& scans) {
  std::vector<double> differences;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const RangeScan& before = scans[i - 1];
    const RangeScan& after = scans[i];
    if (!before.base || !after.base || !IsAtRest(*before.base, *after.base)) continue;
    AddDifferences(before.ranges, after.ranges, differences);
  }
  return differences;
}

std::vector<double> RestDifferences(const std::vector<ScanPair>& pairs) {
  std::vector<double> differences;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    AddDifferences(pairs[i - 1].simulated, pairs[i].simulated, differences);
  }
  return differences;
}

std::vector<double> MedianDifferences(const std::vector<ScanPair>& pairs) {
  std::vector<double> medians;
  for (const ScanPair& pair : pairs) {
    std::vector<double> off;
    for (std::size_t i = 0; i < std::min(pair.real.size(), pair.simulated.size()); ++i) {
      if (std::isfinite(pair.real[i]) && std::isfinite(pair.simulated[i])) {
        off.push_back(std::abs(pair.real[i] - pair.simulated[i]));
      }
    }
    if (!off.empty()) medians.push_back(Quantile(std::move(off), 0.5));
  }
  return medians;
}

}  // namespace gsv::reality
