// Fits parameters of simulated devices to a log, see comparison.h.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "gsv/reality/comparison.h"
#include "gsv/reality/odometry_comparison.h"
#include "gsv/reality/option_check.h"
#include "gsv/reality/radio_comparison.h"
#include "gsv/reality/scan_placing.h"
#include "gsv/reality/statistics.h"
#include "gsv/reality/world_fit.h"

namespace gsv::reality {
namespace {

constexpr double kFitWindow = 5;       // s
constexpr double kFitTolerance = 0.5;  // m
constexpr double kInterval = 1.96;

constexpr std::size_t kParts = 10;  // number of parts of the data, for jackknife intervals

template <typename T>
std::vector<T> Without(const std::vector<T>& all, std::size_t part) {
  std::vector<T> rest;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i * kParts / all.size() != part) rest.push_back(all[i]);
  }
  return rest;
}

FittedDevice FitOdometry(const Log& log, const CompareOptions& options) {
  const auto windows =
      Windows(ReckonedPath(log, options.wheel_distance, log.truth.front()), log.truth, kFitWindow);
  FittedDevice device{"odometry", "odometry", {}};
  if (windows.size() < 2) {
    device.warning = fmt::format(
        "the log is too short to fit odometry, which needs two windows of {} s with a reference",
        kFitWindow);
    return device;
  }
  using sensing::OdometryDrift;
  struct Parameter {
    const char* name;
    const char* unit;
    double OdometryDrift::*member;
  };
  constexpr Parameter kParameters[] = {
      {"scale.linear", "", &OdometryDrift::linear_scale},
      {"scale.angular", "", &OdometryDrift::angular_scale},
      {"random.linear_per_metre", "m", &OdometryDrift::linear_per_metre},
      {"random.angular_per_metre", "rad", &OdometryDrift::angular_per_metre},
      {"random.angular_per_radian", "rad", &OdometryDrift::angular_per_radian}};
  const OdometryDrift all = FitDrift(windows);
  std::vector<OdometryDrift> without;
  for (std::size_t part = 0; part < kParts; ++part)
    without.push_back(FitDrift(Without(windows, part)));
  for (const Parameter& parameter : kParameters) {
    std::vector<double> values;
    for (const OdometryDrift& drift : without) values.push_back(drift.*parameter.member);
    device.parameters.push_back(
        {parameter.name, parameter.unit, all.*parameter.member, JackknifeInterval(values)});
  }
  return device;
}

// Computes a function of the scans, and its 95 % interval.
template <typename Estimate>
FittedParameter Estimated(const char* name, const char* unit, const std::vector<ScanPair>& pairs,
                          const Estimate& estimate) {
  std::vector<double> without;
  for (std::size_t part = 0; part < kParts; ++part)
    without.push_back(estimate(Without(pairs, part)));
  return {name, unit, estimate(pairs), JackknifeInterval(without)};
}

double MeanShortRange(const std::vector<ScanPair>& pairs) {
  double sum = 0, count = 0;
  for (const ScanPair& pair : pairs) {
    for (std::size_t i = 0; i < std::min(pair.real.size(), pair.exact.size()); ++i) {
      if (pair.real[i] < pair.exact[i] - kFitTolerance) sum += pair.real[i], ++count;
    }
  }
  return count > 0 ? std::max(sum / count, 1e-3) : 1;
}

FittedDevice FitLidar(const Log& log, const std::vector<ScanPair>& pairs) {
  FittedDevice device{"lidar", "lidar", {}};
  const std::vector<double> rest = RestDifferences(log.scans);
  if (rest.size() >= 100) {
    const double deviation = Summarize(rest).deviation;
    device.parameters.push_back(
        {"noise.stddev", "m", deviation,
         kInterval * deviation / std::sqrt(2.0 * static_cast<double>(rest.size()))});
  }
  device.parameters.push_back(Estimated(
      "noise.dropout_probability", "", pairs,
      [](const std::vector<ScanPair>& some) { return MixtureOf(some, true, kFitTolerance).none; }));
  device.parameters.push_back(Estimated("short_range", "m", pairs, MeanShortRange));
  const double scale = device.parameters.back().value;
  device.parameters.push_back(
      Estimated("short_probability", "", pairs, [scale](const std::vector<ScanPair>& some) {
        // A short reading is one that ends before the surface. The simulation draws a random range
        // for it. A range beyond the surface has no effect: the reading remains as it is. So the
        // fraction of drawn short readings must be larger than the observed fraction.
        double nearer = 0, beams = 0;
        for (const ScanPair& pair : some) {
          for (const double exact : pair.exact) {
            if (!std::isfinite(exact)) continue;
            nearer += 1 - std::exp(-std::max(0.0, exact - kFitTolerance) / scale);
            ++beams;
          }
        }
        const double shorter = MixtureOf(some, true, kFitTolerance).shorter;
        return nearer > 0 ? std::min(1.0, shorter * beams / nearer) : 0;
      }));
  // Omits both parameters of short readings unless the half-widths of both intervals are less than
  // half of the values. Without these parameters, the simulation makes no short readings.
  const std::size_t shared = device.parameters.size() - 2;
  device.warning = WarningAbout(MixtureOf(pairs, true, kFitTolerance), kFitTolerance);
  const bool is_known = std::all_of(
      device.parameters.begin() + static_cast<std::ptrdiff_t>(shared), device.parameters.end(),
      [](const FittedParameter& each) { return each.confidence < each.value / 2; });
  if (!is_known) device.parameters.resize(shared);
  return device;
}

// A parameter of a sonar's reflections whose best value is searched. The search changes one
// parameter at a time.
struct Searched {
  const char* name;
  const char* unit;
  double value;
  std::vector<double> tries;  // factors
  double low, high;
};

class SonarFit {
 public:
  SonarFit(const Log& log, const CompareOptions& options) : log_(log), options_(options) {}

  base::Result<std::vector<FittedDevice>> Run() {
    // A share is the fraction of a sonar's readings that have an echo. The simulated shares are
    // computed at the poses of the odd blocks (world_fit.h), because the world was not fitted to
    // the readings there. The real shares are computed from the readings of the even blocks. The
    // real readings of the odd blocks are not used.
    auto placed = PlaceScans(log_, options_, false);
    if (!placed) return base::Fail(placed.error());
    placed_ = *std::move(placed);
    std::vector<ScanPair> fitted;
    for (const RangeScan& scan : ScansFor(log_, true)) fitted.push_back({{}, scan.ranges, {}, {}});
    real_ = EchoShares(fitted, true);
    // The slopes of a rough surface are normally distributed, and specular_width is their deviation
    // (Kirchhoff's approximation). A large value is possible, because walls with mouldings return
    // sound that arrives obliquely.
    std::vector<Searched> searched = {{"specular_width", "rad", 0.1, {0.5, 2, 3, 4.5}, 0.01, 0.8},
                                      {"roughness", "", 0.1, {0.2, 0.5, 2, 4}, 1e-3, 1},
                                      {"threshold", "", 0.02, {0.5, 2, 4}, 1e-3, 0.9},
                                      {"gain_range", "m", 3, {0.5, 0.75, 1.4, 2}, 0.2, 50}};
    auto best = Cost(searched);
    if (!best) return base::Fail(best.error());
    for (int round = 0; round < 4; ++round) {
      for (Searched& each : searched) {
        const double from = each.value;
        for (const double factor : each.tries) {
          const double before = each.value;
          each.value = std::clamp(from * std::pow(factor, 1.0 / (1 + round)), each.low, each.high);
          const auto cost = Cost(searched);
          if (!cost) return base::Fail(cost.error());
          if (*cost < *best) {
            best = cost;
          } else {
            each.value = before;
          }
        }
      }
    }
    FittedDevice shared{"sonar", "", {}};
    for (Searched& each : searched) {
      const double value = each.value;
      auto interval = IntervalOf(searched, each, *best);
      if (!interval) return base::Fail(interval.error());
      each.value = value;
      shared.parameters.push_back({each.name, each.unit, value, *interval});
    }
    return WithLosses(searched, shared);
  }

 private:
  // Returns one device for each sonar. The sonars of a ring are not equally sensitive. If a real
  // sonar returns fewer echoes than the simulation with the shared parameters, the missing fraction
  // of echoes becomes the dropout probability of this sonar.
  base::Result<std::vector<FittedDevice>> WithLosses(const std::vector<Searched>& searched,
                                                     const FittedDevice& shared) {
    const auto pairs = PairsWith(searched);
    if (!pairs) return base::Fail(pairs.error());
    const std::vector<double>& real = real_;
    const std::vector<double> simulated = EchoShares(*pairs, false);
    std::vector<FittedDevice> devices;
    for (std::size_t i = 0; i < real.size(); ++i) {
      FittedDevice device = shared;
      device.name = fmt::format("sonar_{}", i);
      const double lost = simulated[i] > 0 ? std::clamp(1 - real[i] / simulated[i], 0.0, 1.0) : 0;
      const double interval =
          kInterval * std::sqrt(real[i] * (1 - real[i]) / static_cast<double>(pairs->size()));
      device.parameters.push_back(
          {"noise.dropout_probability", "", lost, simulated[i] > 0 ? interval / simulated[i] : 1});
      devices.push_back(std::move(device));
    }
    return devices;
  }

  base::Result<std::vector<ScanPair>> PairsWith(const std::vector<Searched>& searched) {
    CompareOptions options = options_;
    for (const Searched& each : searched) options.parameters[each.name] = each.value;
    return PairScans(placed_, log_, options);
  }

  // Returns chi squared of the fractions of echoes: the sum of their squared differences, each
  // divided by its variance.
  base::Result<double> Cost(const std::vector<Searched>& searched) {
    const auto pairs = PairsWith(searched);
    if (!pairs) return base::Fail(pairs.error());
    const std::vector<double>& real = real_;
    const std::vector<double> simulated = EchoShares(*pairs, false);
    double cost = 0;
    for (std::size_t i = 0; i < real.size(); ++i) {
      const double variance =
          std::max(real[i] * (1 - real[i]), 0.02) * 2 / static_cast<double>(pairs->size());
      cost += (real[i] - simulated[i]) * (real[i] - simulated[i]) / variance;
    }
    return cost;
  }

  // Returns the increase of the parameter that makes the cost more than 3.84 higher (95 % for one
  // degree of freedom). Tries increases of 10 %, 40 % and 70 %. Returns the value of the parameter
  // if none of them suffices.
  base::Result<double> IntervalOf(std::vector<Searched>& searched, Searched& each, double best) {
    const double value = each.value;
    for (double part = 0.1; part < 1; part += 0.3) {
      each.value = std::min(value * (1 + part), each.high);
      const auto cost = Cost(searched);
      if (!cost) return base::Fail(cost.error());
      if (*cost > best + kInterval * kInterval) return each.value - value;
    }
    return value;
  }

  const Log& log_;
  const CompareOptions& options_;
  PlacedScans placed_;
  std::vector<double> real_;  // fraction of readings with an echo, by sonar
};

}  // namespace

base::Result<std::vector<FittedDevice>> Fit(const Log& given, const CompareOptions& options) {
  const Log log = WithBases(given, options);
  if (auto ok = CheckOptions(log, options); !ok) return base::Fail(ok.error());
  std::vector<FittedDevice> devices;
  if (HasOdometry(log)) {
    devices.push_back(FitOdometry(log, options));
  }
  if (HasScans(log)) {
    if (log.is_sonar) {
      auto sonars = SonarFit(log, options).Run();
      if (!sonars) return base::Fail(sonars.error());
      devices.insert(devices.end(), sonars->begin(), sonars->end());
    } else {
      const auto placed = PlaceScans(log, options, true);
      if (!placed) return base::Fail(placed.error());
      const auto pairs = PairScans(*placed, log, options);
      if (!pairs) return base::Fail(pairs.error());
      if (!pairs->empty()) devices.push_back(FitLidar(log, *pairs));
    }
  }
  if (!log.radio.empty()) devices.push_back(FitRanging(log));
  const bool is_too_short = !devices.empty() && std::all_of(devices.begin(), devices.end(),
                                                            [](const FittedDevice& device) {
                                                              return device.parameters.empty();
                                                            });
  if (is_too_short) {
    return base::Fail(base::ErrorCode::kInvalidArgument, devices.front().warning);
  }
  if (devices.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the log has nothing to fit a device to: it needs scans with poses, or "
                      "odometry or commands with a reference, or radio ranges");
  }
  return devices;
}

std::string ToSdf(const std::vector<FittedDevice>& devices) {
  std::string sdf;
  for (const FittedDevice& device : devices) {
    if (!device.warning.empty()) sdf += "<!-- " + device.warning + " -->\n";
    if (device.parameters.empty()) continue;
    sdf += fmt::format("<sensor name=\"{}\" type=\"{}\">\n", device.name, device.type);
    // Parameters of one group ("noise.mean", "noise.stddev") go into one element.
    std::map<std::string, std::string> groups;
    for (const FittedParameter& parameter : device.parameters) {
      const std::size_t dot = parameter.name.find('.');
      const bool is_grouped = dot != std::string::npos;
      const std::string name = is_grouped ? parameter.name.substr(dot + 1) : parameter.name;
      const std::string line =
          fmt::format("{}<gsv:{}>{:.4g}</gsv:{}>  <!-- ± {:.2g}{} -->\n",
                      is_grouped ? "    " : "  ", name, parameter.value, name, parameter.confidence,
                      parameter.unit.empty() ? "" : " " + parameter.unit);
      (is_grouped ? groups[parameter.name.substr(0, dot)] : sdf) += line;
    }
    for (const auto& [group, lines] : groups) {
      sdf += fmt::format("  <gsv:{}>\n{}  </gsv:{}>\n", group, lines, group);
    }
    sdf += "</sensor>\n";
  }
  return sdf;
}

}  // namespace gsv::reality
