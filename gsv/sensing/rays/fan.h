// A fan: the rays of one row of a lidar, from one point and at evenly spaced azimuths.
//
// Exactness  the sector of a solid contains every ray that touches it; callers compute the
//            intersections.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "gsv/geometry/pose.h"
#include "gsv/geometry/triangle_mesh.h"

namespace gsv::sensing {

// Ray i has the azimuth first + i * step about the z axis of the fan's frame, counted from the x
// axis. All rays have the same elevation over the xy plane.
struct Fan {
  geometry::Pose world_from_fan;
  double first = 0, step = 0;                     // rad; step > 0 unless there is only one ray
  double elevation = 0;                           // rad
  double max_distance = 0;                        // m
  std::span<const geometry::Vector3> directions;  // unit vectors along the rays, in the fan's frame
};

// The part of a fan that a solid may occlude: azimuths between `from` and `to`, or all.
struct Sector {
  double nearest = 0;  // distance from the fan's origin to the solid's box, m
  double from = 0, to = 0;
  bool is_all = false;
};

// Returns the sector of a box in its own frame; nothing if no ray passes near it.
std::optional<Sector> SectorOf(const Fan& fan, const geometry::Pose& box_from_fan,
                               const geometry::Bounds& box);

// Calls visit(ray) once for each ray in a sector.
template <class Visit>
void ForRaysIn(const Sector& sector, const Fan& fan, const Visit& visit) {
  const auto count = static_cast<std::ptrdiff_t>(fan.directions.size());
  if (sector.is_all || !(fan.step > 0)) {
    for (std::ptrdiff_t i = 0; i < count; ++i) visit(static_cast<std::size_t>(i));
    return;
  }
  constexpr double kTurn = 2 * std::numbers::pi;
  constexpr double kRounding = 1e-6;  // as a fraction of a step
  const double last = fan.first + static_cast<double>(count - 1) * fan.step;
  const double width = sector.to - sector.from;
  const double slack = kRounding * fan.step;
  // A fan may span more than one turn.
  double from = sector.from + kTurn * std::ceil((fan.first - sector.to - slack) / kTurn);
  for (; from <= last + slack; from += kTurn) {
    const double begin = std::ceil((from - fan.first) / fan.step - kRounding);
    const double end = std::floor((from + width - fan.first) / fan.step + kRounding);
    const auto low = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(begin));
    const auto high = std::min<std::ptrdiff_t>(count - 1, static_cast<std::ptrdiff_t>(end));
    for (std::ptrdiff_t i = low; i <= high; ++i) visit(static_cast<std::size_t>(i));
  }
}

}  // namespace gsv::sensing
