#include "gsv/reality/comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/odometry_comparison.h"
#include "gsv/reality/option_check.h"
#include "gsv/reality/radio_comparison.h"
#include "gsv/reality/scan_placing.h"
#include "gsv/reality/simulated_device.h"
#include "gsv/reality/statistics.h"
#include "gsv/reality/world_fit.h"
#include "gsv/sensing/presets.h"

namespace gsv::reality {
namespace {

constexpr double kWindow = 5;  // s
// The tolerance for the end of a laser beam, m. The walls of a grid map are several cells thick,
// and the true position of the surface inside them is unknown.
constexpr double kTolerance = 0.5;
constexpr double k95 = 1.96;

base::Result<sensing::OdometryDrift> DriftOf(const CompareOptions& options) {
  model::SensorDescription description;
  description.name = description.type = "odometry";
  description.parameters = options.parameters;
  const std::string preset = PresetOf("odometry", options);
  if (!preset.empty()) description.parameters.emplace("preset", preset);
  const auto whole = sensing::WithPreset("odometry", description);
  if (!whole) return base::Fail(whole.error());
  sensing::ParameterReader reader(*whole);
  const sensing::OdometryDrift drift = sensing::ReadOdometryDrift(reader);
  if (!reader.status()) return base::Fail(reader.status().error());
  return drift;
}

// Returns the distance between the reckoned and the true position at the last instant that both paths
// have, after they were aligned at their first common instant. NaN if they have none.
double EndError(const std::vector<TimedPose>& reckoned, const std::vector<TimedPose>& truth) {
  const double begin = std::max(reckoned.front().time, truth.front().time);
  const double finish = std::min(truth.back().time, reckoned.back().time);
  if (begin > finish) return std::nan("");
  const auto at = [](const std::vector<TimedPose>& path, double time) {
    return PoseAt(path, time, geometry::kInfinity);
  };
  const auto first = at(reckoned, begin), last = at(reckoned, finish);
  const auto from = at(truth, begin), end = at(truth, finish);
  if (!first || !last || !from || !end) return std::nan("");
  const double turn = from->yaw - first->yaw;
  const double dx = last->x - first->x, dy = last->y - first->y;
  return std::hypot(from->x + std::cos(turn) * dx - std::sin(turn) * dy - end->x,
                    from->y + std::sin(turn) * dx + std::cos(turn) * dy - end->y);
}

void AddWarning(const std::string& warning, Comparison& result) {
  if (warning.empty()) return;
  result.warning += (result.warning.empty() ? "" : "; ") + warning;
}

base::Status CompareOdometry(const Log& log, const CompareOptions& options, Comparison& result) {
  const auto drift = DriftOf(options);
  if (!drift) return base::Fail(drift.error());
  const std::vector<TimedPose> path = ReckonedPath(log, options.wheel_distance, log.truth.front());
  const std::vector<MotionWindow> windows = Windows(path, log.truth, kWindow);
  const MotionStatistics real = StatisticsOf(windows);
  std::vector<double> way, turn, way_scatter, turn_scatter, ends;
  Series way_series{"way", "m", real.way_residuals, {}};
  Series turn_series{"turn", "rad", real.turn_residuals, {}};
  for (int run = 0; run < options.runs; ++run) {
    const auto odometry =
        SimulatedOdometry(log.truth, *drift, options.seed + static_cast<std::uint64_t>(run));
    const MotionStatistics one = StatisticsOf(Windows(odometry, log.truth, kWindow));
    way.push_back(one.way_ratio), turn.push_back(one.turn_ratio);
    way_scatter.push_back(one.way_scatter), turn_scatter.push_back(one.turn_scatter);
    ends.push_back(EndError(odometry, log.truth));
    way_series.simulated.insert(way_series.simulated.end(), one.way_residuals.begin(),
                                one.way_residuals.end());
    turn_series.simulated.insert(turn_series.simulated.end(), one.turn_residuals.begin(),
                                 one.turn_residuals.end());
  }
  const auto add = [&](const char* what, const char* unit, double real_value,
                       const std::vector<double>& simulated) {
    const Summary summary = Summarize(simulated);
    result.rows.push_back(
        {"odometry", what, unit, real_value, summary.mean, k95 * summary.deviation});
  };
  add("error at the end", "m", EndError(path, log.truth), ends);
  if (windows.size() < 2) {
    AddWarning(fmt::format("the log is too short for statistics of the odometry, which need two "
                           "windows of {} s with a reference",
                           kWindow),
               result);
    return {};
  }
  add("true distance / estimated distance", "", real.way_ratio, way);
  add("true turn / estimated turn", "", real.turn_ratio, turn);
  add("scatter of the distance in 5 s", "m", real.way_scatter, way_scatter);
  add("scatter of the turn in 5 s", "rad", real.turn_scatter, turn_scatter);
  result.rows.push_back({"odometry", "Kolmogorov-Smirnov distance of path lengths", "", 0,
                         KolmogorovSmirnov(way_series.real, way_series.simulated), 0});
  result.rows.push_back({"odometry", "Kolmogorov-Smirnov distance of the turn", "", 0,
                         KolmogorovSmirnov(turn_series.real, turn_series.simulated), 0});
  result.series.push_back(std::move(way_series));
  result.series.push_back(std::move(turn_series));
  return {};
}

void AddScanMedians(const std::string& device, const std::vector<ScanPair>& pairs,
                    Comparison& result) {
  const std::vector<double> medians = MedianDifferences(pairs);
  if (medians.empty()) return;
  const auto below =
      std::count_if(medians.begin(), medians.end(), [](double m) { return m < 0.01; });
  const double nothing = std::nan("");
  result.rows.push_back(
      {device, "median difference of a scan, middle", "m", Quantile(medians, 0.5), nothing, 0});
  result.rows.push_back(
      {device, "median difference of a scan, largest", "m", Quantile(medians, 1), nothing, 0});
  result.rows.push_back({device, "share of scans with a median difference below 10 mm", "",
                         static_cast<double>(below) / static_cast<double>(medians.size()), nothing,
                         0});
}

void CompareScans(const Log& log, const std::vector<ScanPair>& pairs, Comparison& result) {
  const char* const device = log.is_sonar ? "sonar" : "lidar";
  const auto count = static_cast<double>(pairs.size());
  const std::vector<double> real = EchoShares(pairs, true), simulated = EchoShares(pairs, false);
  const auto share = [&](const std::string& what, double a, double b, double trials) {
    constexpr double kRounding = 1e-12;
    a = a < kRounding ? 0 : a, b = b < kRounding ? 0 : b;
    result.rows.push_back({device, what, "", a, b, k95 * std::sqrt(b * (1 - b) / trials)});
  };
  if (real.size() <= 16) {
    for (std::size_t i = 0; i < real.size(); ++i) {
      share(fmt::format("share of beams with an echo at {:.1f}°",
                        log.beam_angles[i] * 180 / geometry::kPi),
            real[i], simulated[i], count);
    }
  } else {
    // Returns the mean over a sector of thirty degrees.
    const auto mean = [](const std::vector<double>& values, std::size_t from, std::size_t to) {
      double sum = 0;
      for (std::size_t i = from; i < to; ++i) sum += values[i];
      return sum / static_cast<double>(to - from);
    };
    constexpr double kSector = geometry::kPi / 6;
    for (std::size_t from = 0; from < real.size();) {
      std::size_t to = from + 1;
      const double first = log.beam_angles[from];
      while (to < real.size() && log.beam_angles[to] - first < kSector) ++to;
      share(fmt::format("share of beams with an echo from {:.0f} to {:.0f}°",
                        first * 180 / geometry::kPi, log.beam_angles[to - 1] * 180 / geometry::kPi),
            mean(real, from, to), mean(simulated, from, to),
            count * static_cast<double>(to - from));
      from = to;
    }
  }
  Series ranges{"range", "m", {}, {}}, residuals{"residual", "m", {}, {}};
  // The mean residual of each scan. A residual is the measured minus the exact range, m.
  std::vector<double> real_mean, simulated_mean;
  for (const ScanPair& pair : pairs) {
    std::vector<double> of_real, of_simulated;
    for (std::size_t i = 0; i < std::min(pair.real.size(), pair.exact.size()); ++i) {
      if (std::isfinite(pair.real[i])) ranges.real.push_back(pair.real[i]);
      if (std::isfinite(pair.simulated[i])) ranges.simulated.push_back(pair.simulated[i]);
      if (std::abs(pair.real[i] - pair.exact[i]) <= kTolerance) {
        of_real.push_back(pair.real[i] - pair.exact[i]);
      }
      if (std::abs(pair.simulated[i] - pair.exact[i]) <= kTolerance) {
        of_simulated.push_back(pair.simulated[i] - pair.exact[i]);
      }
    }
    residuals.real.insert(residuals.real.end(), of_real.begin(), of_real.end());
    residuals.simulated.insert(residuals.simulated.end(), of_simulated.begin(), of_simulated.end());
    real_mean.push_back(Summarize(of_real).mean);
    simulated_mean.push_back(Summarize(of_simulated).mean);
  }
  const Summary a = Summarize(residuals.real), b = Summarize(residuals.simulated);
  const double root = std::sqrt(std::max<double>(1, static_cast<double>(b.count)));
  result.rows.push_back({device, "mean residual", "m", a.mean, b.mean, k95 * b.deviation / root});
  result.rows.push_back({device, "deviation of residuals", "m", a.deviation, b.deviation,
                         k95 * b.deviation / (root * std::sqrt(2.0))});
  result.rows.push_back({device, "autocorrelation of the scans' mean residuals (lag 1)", "",
                         Autocorrelation(real_mean, 1), Autocorrelation(simulated_mean, 1),
                         k95 / std::sqrt(std::max(1.0, count))});
  result.rows.push_back({device, "Kolmogorov-Smirnov distance of ranges", "", 0,
                         KolmogorovSmirnov(ranges.real, ranges.simulated), 0});
  if (!log.is_sonar) AddScanMedians(device, pairs, result);
  const Mixture real_mix = MixtureOf(pairs, true, kTolerance);
  const Mixture mix = MixtureOf(pairs, false, kTolerance);
  AddWarning(WarningAbout(real_mix, kTolerance), result);
  const double beams = count * static_cast<double>(real.size());
  double heard = 0, simulated_heard = 0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    heard += real[i] / static_cast<double>(real.size());
    simulated_heard += simulated[i] / static_cast<double>(real.size());
  }
  share("share of all beams at the maximum", 1 - heard, 1 - simulated_heard, beams);
  share("share of hits", real_mix.hit, mix.hit, beams);
  share("share of shorter readings", real_mix.shorter, mix.shorter, beams);
  share("share without an echo", real_mix.none, mix.none, beams);
  share("share of longer readings", real_mix.longer, mix.longer, beams);
  result.series.push_back(std::move(ranges));
  result.series.push_back(std::move(residuals));
}

// Compares readings at rest: the simulated device stays at the first pose of the log's robot.
void CompareAtRest(const Log& log, const model::WorldDescription& world,
                   const CompareOptions& options, const TimedPose& pose, Comparison& result) {
  const std::vector<double> real = RestDifferences(log.scans);
  if (real.size() < 100) return;
  auto device = SimulatedDevice::Create(world, ConfiguredSensors(log, options), options.seed);
  if (!device) return;
  constexpr int kScans = 30;
  std::vector<ScanPair> pairs;
  for (int i = 0; i < kScans; ++i) {
    ScanPair pair{pose, {}, device->Read(pose, i), {}};
    MarkMissing(pair.simulated, log.max_range);
    pairs.push_back(std::move(pair));
  }
  const Summary a = Summarize(real), b = Summarize(RestDifferences(pairs));
  result.rows.push_back({log.is_sonar ? "sonar" : "lidar", "scatter of a beam at rest", "m",
                         a.deviation, b.deviation,
                         k95 * b.deviation / std::sqrt(2.0 * static_cast<double>(b.count) + 1)});
}

base::Status CompareRadio(const Log& log, const CompareOptions& options, Comparison& result) {
  const auto simulated = SimulatedRanges(log, options);
  if (!simulated) return base::Fail(simulated.error());
  std::vector<RadioErrors> errors;
  for (std::size_t i = 0; i < log.radio.size(); ++i) {
    const RadioRange& range = log.radio[i];
    if (IsForFitting(range.time)) continue;
    errors.push_back({range.anchor, range.reference, range.measured - range.reference,
                      (*simulated)[i] - range.reference});
  }
  Series series{"error of a range", "m", {}, {}};
  for (const RadioGroup& group : Grouped(errors)) {
    const Summary real = Summarize(group.real), other = Summarize(group.simulated);
    const double root = std::sqrt(std::max<double>(1, static_cast<double>(other.count)));
    result.rows.push_back({"ranging", "bias " + group.name, "m", real.mean, other.mean,
                           k95 * other.deviation / root});
    result.rows.push_back({"ranging", "scatter " + group.name, "m", real.deviation, other.deviation,
                           k95 * other.deviation / (root * std::sqrt(2.0))});
  }
  for (const RadioErrors& error : errors) {
    series.real.push_back(error.real);
    if (std::isfinite(error.simulated)) series.simulated.push_back(error.simulated);
  }
  result.rows.push_back({"ranging", "Kolmogorov-Smirnov distance of the errors", "", 0,
                         KolmogorovSmirnov(series.real, series.simulated), 0});
  result.series.push_back(std::move(series));
  return {};
}

}  // namespace

base::Result<Comparison> Compare(const Log& given, const CompareOptions& options) {
  const Log log = WithBases(given, options);
  Comparison result;
  if (auto ok = CheckOptions(log, options); !ok) return base::Fail(ok.error());
  if (HasOdometry(log)) {
    if (auto ok = CompareOdometry(log, options, result); !ok) return base::Fail(ok.error());
  }
  if (HasScans(log)) {
    const auto placed = PlaceScans(log, options, false);
    if (!placed) return base::Fail(placed.error());
    const auto pairs = PairScans(*placed, log, options);
    if (!pairs) return base::Fail(pairs.error());
    if (!pairs->empty()) {
      CompareScans(log, *pairs, result);
      CompareAtRest(log, placed->world, options, pairs->front().pose, result);
    }
  }
  if (!log.radio.empty()) {
    if (auto ok = CompareRadio(log, options, result); !ok) return base::Fail(ok.error());
  }
  if (result.rows.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      HasScans(log) ? "the log is too short: every second block of 4 s is used for "
                                      "the comparison, and there are no scans in these blocks"
                                    : "the log has nothing to compare: it needs scans with poses, "
                                      "odometry or commands with a reference, or radio ranges");
  }
  return result;
}

}  // namespace gsv::reality
