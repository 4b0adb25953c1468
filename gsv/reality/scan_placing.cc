#include "gsv/reality/scan_placing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/localization.h"
#include "gsv/reality/maps/map_world.h"
#include "gsv/reality/odometry_comparison.h"
#include "gsv/reality/simulated_device.h"
#include "gsv/reality/world_fit.h"
#include "gsv/sensing/presets.h"

namespace gsv::reality {
namespace {

constexpr double kCell = 0.1, kUpdatedCell = 0.05, kFineCell = 0.02;  // m
constexpr double kSmallWorld = 10;  // m; in a smaller world, poses are searched in a fine map

std::vector<RangeScan> Thinned(std::vector<RangeScan> scans, std::size_t most) {
  const std::size_t stride = std::max<std::size_t>(1, (scans.size() + most - 1) / most);
  std::vector<RangeScan> thinned;
  for (std::size_t i = 0; i < scans.size(); i += stride) thinned.push_back(std::move(scans[i]));
  return thinned;
}

// Returns the map in which poses are searched. A small world gets a finer map.
base::Result<OccupancyMap> SearchMap(const model::WorldDescription& world, double height) {
  auto map = MapOfWorld(world, {kCell, height, 1});
  if (!map || std::max(map->width, map->height) * kCell > kSmallWorld) return map;
  return MapOfWorld(world, {kFineCell, height, 1});
}

// Improves a pose until the exact ranges at this pose fit the scan. A range difference above kWild
// counts as kWild, so that outliers have a limited effect.
class PoseRefiner {
 public:
  PoseRefiner(SimulatedDevice& exact, double max_range) : exact_(exact), max_range_(max_range) {}

  TimedPose Refined(const RangeScan& scan, TimedPose pose) {
    double best = Cost(scan, pose);
    for (double step = 0.03; step > 5e-4; step /= 2) {
      for (bool is_better = true; is_better;) {
        is_better = false;
        const TimedPose from = pose;
        const double ways[6][3] = {{step, 0, 0},  {-step, 0, 0}, {0, step, 0},
                                   {0, -step, 0}, {0, 0, step},  {0, 0, -step}};
        for (const auto& way : ways) {
          const TimedPose there{from.time, from.x + way[0], from.y + way[1], from.yaw + way[2]};
          const double cost = Cost(scan, there);
          if (cost < best - 1e-9) best = cost, pose = there, is_better = true;
        }
      }
    }
    return pose;
  }

 private:
  double Cost(const RangeScan& scan, const TimedPose& pose) {
    constexpr double kWild = 0.04;  // m
    std::vector<double> exact = exact_.Read(pose, 0);
    MarkMissing(exact, max_range_);
    double cost = 0;
    for (std::size_t i = 0; i < std::min(exact.size(), scan.ranges.size()); ++i) {
      if (!std::isfinite(scan.ranges[i])) continue;
      const double off = std::abs(scan.ranges[i] - exact[i]);
      cost += off < kWild ? off : kWild;  // infinite and undefined differences count as kWild
    }
    return cost;
  }

  SimulatedDevice& exact_;
  const double max_range_;
};

// Returns the scans with their poses in the world that the options name.
base::Result<std::vector<RangeScan>> ScansIn(const Log& log, const CompareOptions& options) {
  if (log.is_sonar || (log.truth_has_yaw && !log.truth.empty())) return log.scans;
  const auto map = SearchMap(*options.world, options.height);
  if (!map) return base::Fail(map.error());
  // A known bias is subtracted from the ranges before poses are searched.
  Log unbiased = log;
  const double bias = model::NumberOr(options.parameters, "noise.mean", 0);
  for (RangeScan& scan : unbiased.scans) {
    for (double& range : scan.ranges) range -= bias;
  }
  const std::size_t stride =
      std::max<std::size_t>(1, (log.scans.size() + options.max_scans - 1) / options.max_scans);
  const auto poses = Localize(unbiased, LikelihoodField(*map), options.start, stride);
  if (!poses) return base::Fail(poses.error());
  auto exact =
      SimulatedDevice::Create(*options.world, SensorsOf(log, "", {}, options.height), options.seed);
  if (!exact) return base::Fail(exact.error());
  PoseRefiner refiner(*exact, log.max_range);
  std::vector<RangeScan> placed;
  for (std::size_t i = 0; i < poses->size(); ++i) {
    placed.push_back(log.scans[i * stride]);
    placed.back().base = map->resolution < kCell
                             ? refiner.Refined(unbiased.scans[i * stride], (*poses)[i])
                             : (*poses)[i];
  }
  return placed;
}

// Updates the map of the options' world by the scans `for_world`, and returns it. Also refines the
// poses of all scans, because they were found in the map before the update.
base::Result<OccupancyMap> UpdatedWorld(const Log& log, const CompareOptions& options,
                                        std::vector<RangeScan>& for_world,
                                        std::vector<RangeScan>& to_read) {
  constexpr int kRounds = 2;
  constexpr double kReach = 0.1;  // m
  const auto known = MapOfWorld(*options.world, {kUpdatedCell, options.height, 1});
  if (!known) return known;
  OccupancyMap map = UpdatedMap(*known, log, for_world);
  for (int round = 0; round < kRounds; ++round) {
    const LikelihoodField field(map);
    for (std::vector<RangeScan>* scans : {&for_world, &to_read}) {
      for (RangeScan& scan : *scans) {
        if (scan.base) scan.base = field.Refined(log, scan, *scan.base, kReach);
      }
    }
    map = UpdatedMap(*known, log, for_world);
  }
  return map;
}

// Divides the log's scans into two lists: scans to make a world from, and scans to compare.
void Divide(std::vector<RangeScan>& for_world, std::vector<RangeScan>& to_read, bool for_fitting) {
  std::erase_if(for_world, [](const RangeScan& scan) { return !IsForFitting(scan.time); });
  std::erase_if(to_read,
                [&](const RangeScan& scan) { return IsForFitting(scan.time) != for_fitting; });
  if (!for_fitting) return;
  std::erase_if(for_world, [](const RangeScan& scan) { return IsLateInBlock(scan.time); });
  std::erase_if(to_read, [](const RangeScan& scan) { return !IsLateInBlock(scan.time); });
}

}  // namespace

std::string ScannerOf(const Log& log) { return log.is_sonar ? "sonar" : "lidar"; }

std::string PresetOf(const std::string& type, const CompareOptions& options) {
  for (const sensing::Preset& preset : sensing::Presets()) {
    if (preset.type == type && preset.name == options.preset) return preset.name;
  }
  return "";
}

void MarkMissing(std::vector<double>& ranges, double max_range) {
  for (double& range : ranges) {
    if (!(range < max_range - 1e-9)) range = geometry::kInfinity;
    if (range < 0) range = geometry::kInfinity;
  }
}

std::vector<model::SensorDescription> ConfiguredSensors(const Log& log,
                                                        const CompareOptions& options) {
  auto sensors =
      SensorsOf(log, PresetOf(ScannerOf(log), options), options.parameters, options.height);
  for (std::size_t i = 0; i < std::min(sensors.size(), options.beam_parameters.size()); ++i) {
    for (const auto& [name, value] : options.beam_parameters[i]) {
      sensors[i].parameters[name] = value;
    }
  }
  return sensors;
}

Log WithBases(Log log, const CompareOptions& options) {
  if (log.scans.empty() || log.scans.front().base || log.wheels.empty()) return log;
  TimedPose start;
  if (!log.truth.empty()) start = log.truth.front();
  if (options.start) start = *options.start;
  const std::vector<TimedPose> path = ReckonedPath(log, options.wheel_distance, start);
  for (RangeScan& scan : log.scans) {
    scan.base = PoseAt(path, scan.time);
    // A scan before the first wheel reading gets the pose of the first reading. A scan after the
    // last wheel reading gets the pose of the last reading.
    if (!scan.base) scan.base = scan.time < path.front().time ? path.front() : path.back();
  }
  return log;
}

base::Result<PlacedScans> PlaceScans(const Log& given, const CompareOptions& options,
                                     bool for_fitting) {
  const Log log = WithBases(given, options);
  auto scans =
      options.world ? ScansIn(log, options) : base::Result<std::vector<RangeScan>>(log.scans);
  if (!scans) return base::Fail(scans.error());
  if (options.world && !options.update_world) {
    std::erase_if(*scans,
                  [&](const RangeScan& scan) { return IsForFitting(scan.time) != for_fitting; });
    return PlacedScans{*options.world, Thinned(*std::move(scans), options.max_scans)};
  }
  std::vector<RangeScan> for_world = *scans, to_read = *std::move(scans);
  Divide(for_world, to_read, for_fitting);
  auto map = options.world ? UpdatedWorld(log, options, for_world, to_read)
                           : FitMap(log, for_world, kCell);
  if (!map) return base::Fail(map.error());
  return PlacedScans{WallsOf(*map, 1), Thinned(std::move(to_read), options.max_scans)};
}

base::Result<std::vector<ScanPair>> PairScans(const PlacedScans& placed, const Log& log,
                                              const CompareOptions& options) {
  auto device =
      SimulatedDevice::Create(placed.world, ConfiguredSensors(log, options), options.seed);
  if (!device) return base::Fail(device.error());
  auto exact =
      SimulatedDevice::Create(placed.world, SensorsOf(log, "", {}, options.height), options.seed);
  if (!exact) return base::Fail(exact.error());
  std::vector<ScanPair> pairs;
  for (std::size_t i = 0; i < placed.scans.size(); ++i) {
    const RangeScan& scan = placed.scans[i];
    if (!scan.base) continue;
    ScanPair pair{*scan.base, scan.ranges, {}, {}};
    pair.simulated = device->Read(pair.pose, static_cast<std::int64_t>(i));
    pair.exact = exact->Read(pair.pose, 0);
    // A parameter, such as scan.horizontal.resolution, can change the number of beams. Intensities
    // follow the ranges.
    const std::size_t beams = scan.ranges.size();
    if (pair.simulated.size() < beams || pair.exact.size() < beams) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        fmt::format("the simulated device has {} beams, and the log has {}; do not "
                                    "set the parameters of its beams",
                                    std::min(pair.simulated.size(), pair.exact.size()), beams));
    }
    MarkMissing(pair.simulated, log.max_range);
    MarkMissing(pair.exact, log.max_range);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace gsv::reality
