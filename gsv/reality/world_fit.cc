#include "gsv/reality/world_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gsv/geometry/constants.h"
#include "gsv/model/model.h"

namespace gsv::reality {
namespace {

// Half angle of the cone that returns most of the sound, rad.
constexpr double kSonarHalfAngle = 0.13;
constexpr double kMargin = 6;  // margin around the path for sonars; minimum margin for lasers, m
constexpr double kMaxFittedCells = 25e6;
constexpr double kFurthest = 50;    // echoes from further away are ignored, m
constexpr double kMaxWidth = 1000;  // m
constexpr double kFree = -0.4, kOccupied = 0.9, kKnown = 1.5;
// Log odds above which a cell counts as occupied. FitMap() uses kPerhaps, which needs one echo.
// UpdatedMap() uses kSeenTwice, which needs two echoes in a cell that was not occupied.
constexpr double kPerhaps = 0.5, kSeenTwice = 1.2;
// Log odds of a cell on a line of wall. A smooth wall reflects some sound away, so some readings
// are longer than the distance to the wall. These readings are evidence against the wall, and this
// value exceeds the sum of their evidence.
constexpr double kWall = 10;

// The beam of a sideways sonar moves along walls. Two consecutive echoes of one wall are connected
// by a line.
constexpr double kSideways = 1.2;  // rad
constexpr double kSameWall = 0.4;  // m: maximum change of the range
constexpr double kMaxGap = 2.5;    // m

class LogOdds {
 public:
  LogOdds(OccupancyMap& map) : map_(map), odds_(map.cells.size(), 0) {}

  void Add(double x, double y, double angle, double range, double reach) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double free_to = std::min(std::isfinite(range) ? range - map_.resolution : reach, reach);
    for (double d = map_.resolution; d < free_to; d += map_.resolution / 2) {
      Put(x + d * cosine, y + d * sine, kFree / 2);
    }
    if (std::isfinite(range)) Put(x + range * cosine, y + range * sine, kOccupied);
  }

  void AddWall(double from_x, double from_y, double to_x, double to_y) {
    const double length = std::hypot(to_x - from_x, to_y - from_y);
    for (double d = 0; d < length; d += map_.resolution / 2) {
      Put(from_x + d / length * (to_x - from_x), from_y + d / length * (to_y - from_y), kWall);
    }
  }

  // Adds the evidence of the given map: its occupied cells start with the log odds kKnown.
  void AddKnown() {
    for (std::size_t i = 0; i < odds_.size(); ++i) {
      if (map_.cells[i] == Cell::kOccupied) odds_[i] += kKnown;
    }
  }

  void Finish(double least) {
    for (std::size_t i = 0; i < odds_.size(); ++i) {
      map_.cells[i] =
          odds_[i] > least ? Cell::kOccupied : (odds_[i] < 0 ? Cell::kFree : Cell::kUnknown);
    }
  }

 private:
  void Put(double x, double y, double odds) {
    const double cell_x = (x - map_.origin_x) / map_.resolution;
    const double cell_y = (y - map_.origin_y) / map_.resolution;
    if (!(cell_x >= 0 && cell_y >= 0 && cell_x < map_.width && cell_y < map_.height)) return;
    odds_[static_cast<std::size_t>(cell_y) * static_cast<std::size_t>(map_.width) +
          static_cast<std::size_t>(cell_x)] += odds;
  }

  OccupancyMap& map_;
  std::vector<double> odds_;
};

void JoinWalls(const Log& log, const std::vector<RangeScan>& scans, LogOdds& odds) {
  for (std::size_t i = 0; i < log.beam_angles.size(); ++i) {
    if (std::abs(log.beam_angles[i]) < kSideways) continue;
    double x = 0, y = 0, range = geometry::kInfinity;  // position and range of the last echo
    TimedPose from;                                    // pose from which the echo was measured
    bool is_lost = false;                              // whether readings without an echo followed
    for (const RangeScan& scan : scans) {
      if (!scan.base || i >= scan.ranges.size()) continue;
      if (!std::isfinite(scan.ranges[i])) {
        is_lost = true;
        continue;
      }
      const double angle = scan.base->yaw + log.beam_angles[i];
      const double next_x = scan.base->x + scan.ranges[i] * std::cos(angle);
      const double next_y = scan.base->y + scan.ranges[i] * std::sin(angle);
      const double moved_x = scan.base->x - from.x, moved_y = scan.base->y - from.y;
      if (std::abs(scan.ranges[i] - range) < kSameWall &&
          std::hypot(next_x - x, next_y - y) < kMaxGap) {
        odds.AddWall(x, y, next_x, next_y);
      } else if (std::isfinite(range) && !is_lost && std::hypot(moved_x, moved_y) < kMaxGap) {
        // The echoes come from two different walls. Each wall is extended along the path, to the
        // middle between the echoes.
        odds.AddWall(x, y, x + moved_x / 2, y + moved_y / 2);
        odds.AddWall(next_x - moved_x / 2, next_y - moved_y / 2, next_x, next_y);
      }
      x = next_x, y = next_y, range = scan.ranges[i], from = *scan.base, is_lost = false;
    }
  }
}

// Returns the margin around the path for a laser, m: 1 m more than the range that 98 % of the
// echoes do not exceed, but at least kMargin and at most kFurthest.
double ReachOfEchoes(const std::vector<RangeScan>& scans) {
  constexpr double kNearlyAll = 0.98;
  std::vector<double> ranges;
  for (const RangeScan& scan : scans) {
    std::copy_if(scan.ranges.begin(), scan.ranges.end(), std::back_inserter(ranges),
                 [](double range) { return std::isfinite(range); });
  }
  if (ranges.empty()) return kMargin;
  const auto place = ranges.begin() + static_cast<std::ptrdiff_t>(
                                          kNearlyAll * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), place, ranges.end());
  return std::clamp(*place + 1, kMargin, kFurthest);
}

}  // namespace

bool IsForFitting(double time) {
  return static_cast<long long>(std::floor(time / kBlockSeconds)) % 2 == 0;
}

bool IsLateInBlock(double time) {
  return time / kBlockSeconds - std::floor(time / kBlockSeconds) >= 0.5;
}

std::vector<RangeScan> ScansFor(const Log& log, bool for_fitting) {
  std::vector<RangeScan> scans;
  for (const RangeScan& scan : log.scans) {
    if (IsForFitting(scan.time) == for_fitting) scans.push_back(scan);
  }
  return scans;
}

base::Result<OccupancyMap> FitMap(const Log& log, const std::vector<RangeScan>& scans,
                                  double resolution) {
  double min_x = geometry::kInfinity, min_y = min_x, max_x = -min_x, max_y = -min_x;
  for (const RangeScan& scan : scans) {
    if (!scan.base) continue;
    min_x = std::min(min_x, scan.base->x), max_x = std::max(max_x, scan.base->x);
    min_y = std::min(min_y, scan.base->y), max_y = std::max(max_y, scan.base->y);
  }
  if (!(max_x >= min_x && max_x - min_x < kMaxWidth && max_y - min_y < kMaxWidth)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "no world can be fitted: the scans have no poses, or a path of more than a "
                      "kilometre. Give a world with --world");
  }
  OccupancyMap map;
  map.resolution = resolution;
  const double margin = std::min(log.is_sonar ? kMargin : ReachOfEchoes(scans), log.max_range + 1);
  map.origin_x = min_x - margin, map.origin_y = min_y - margin;
  map.width = static_cast<int>((max_x - min_x + 2 * margin) / resolution) + 1;
  map.height = static_cast<int>((max_y - min_y + 2 * margin) / resolution) + 1;
  if (double{1} * map.width * map.height > kMaxFittedCells) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the path is too wide to fit a world to it. Give a world with --world");
  }
  map.cells.resize(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height),
                   Cell::kUnknown);
  LogOdds odds(map);
  for (const RangeScan& scan : scans) {
    if (!scan.base) continue;
    const double x = scan.base->x + log.sensor_forward * std::cos(scan.base->yaw);
    const double y = scan.base->y + log.sensor_forward * std::sin(scan.base->yaw);
    for (std::size_t i = 0; i < std::min(scan.ranges.size(), log.beam_angles.size()); ++i) {
      const double middle = scan.base->yaw + log.beam_angles[i];
      const double range = scan.ranges[i];
      // Sound without an echo may have been reflected away. So it is evidence of free space only
      // nearby.
      const double reach =
          log.is_sonar ? (std::isfinite(range) ? std::min(range, kFurthest) : 0.6) : margin;
      const double spread = log.is_sonar ? kSonarHalfAngle : 0;
      const double step =
          std::max(0.01, resolution / std::max(1.0, std::isfinite(range) ? range : 1));
      for (double off = -spread; off <= spread + 1e-9; off += step) {
        odds.Add(x, y, middle + off, range, reach);
      }
    }
  }
  if (log.is_sonar) JoinWalls(log, scans, odds);
  odds.Finish(kPerhaps);
  return map;
}

OccupancyMap UpdatedMap(OccupancyMap map, const Log& log, const std::vector<RangeScan>& scans) {
  LogOdds odds(map);
  odds.AddKnown();
  for (const RangeScan& scan : scans) {
    if (!scan.base) continue;
    const double x = scan.base->x + log.sensor_forward * std::cos(scan.base->yaw);
    const double y = scan.base->y + log.sensor_forward * std::sin(scan.base->yaw);
    for (std::size_t i = 0; i < std::min(scan.ranges.size(), log.beam_angles.size()); ++i) {
      // A laser beam without an echo is only weak evidence of free space, because dark surfaces
      // return no echo either.
      if (!std::isfinite(scan.ranges[i])) continue;
      odds.Add(x, y, scan.base->yaw + log.beam_angles[i], scan.ranges[i], kFurthest);
    }
  }
  odds.Finish(kSeenTwice);
  return map;
}

model::WorldDescription WallsOf(const OccupancyMap& map, double height) {
  auto walls = std::make_shared<model::Model>();
  walls->name = "walls";
  walls->links.resize(1);
  for (const CellBox& box : BoxesOf(map)) {
    model::Collision collision;
    collision.shape =
        geometry::Box{{box.width * map.resolution, box.height * map.resolution, height}};
    collision.link_from_collision =
        geometry::PlanarPose((box.x + box.width / 2.0) * map.resolution,
                             (box.y + box.height / 2.0) * map.resolution, height / 2, 0);
    walls->links[0].collisions.push_back(collision);
  }
  model::WorldDescription world;
  model::PlacedModel placed;
  placed.name = "walls";
  placed.model = walls;
  placed.world_from_model = geometry::PlanarPose(map.origin_x, map.origin_y, 0, map.origin_yaw);
  placed.is_static = true;
  world.models.push_back(placed);
  return world;
}

}  // namespace gsv::reality
