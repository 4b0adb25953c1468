// Sectors: the rays of a fan that may hit a solid.
//
// Exactness  the sector of a solid contains every ray that touches it; callers compute the
//            intersections.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/sensing/rays/fan.h"

namespace gsv::sensing {

// The part of a fan that a solid may occlude: azimuths between `from` and `to`, or all.
struct Sector {
  double nearest = 0;  // distance from the fan's origin to the solid's box, m
  double from = 0, to = 0;
  bool is_all = false;
};

// Returns the sector of a box in its own frame; nothing if no ray passes near it.
std::optional<Sector> SectorOf(const Fan& fan, const geometry::Pose& box_from_fan,
                               const geometry::Bounds& box);

// Calls visit(first, last) for each run of rays in a sector. Together, the runs contain each of
// these rays once.
template <class Visit>
void ForRunsIn(const Sector& sector, const Fan& fan, const Visit& visit) {
  const auto count = static_cast<std::ptrdiff_t>(fan.directions.size());
  if (sector.is_all || !(fan.step > 0)) {
    if (count > 0) visit(std::size_t{0}, static_cast<std::size_t>(count - 1));
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
    if (low <= high) visit(static_cast<std::size_t>(low), static_cast<std::size_t>(high));
  }
}

}  // namespace gsv::sensing
