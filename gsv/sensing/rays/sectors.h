// Sectors: the rays of a fan that may hit a solid.
//
// Exactness  the sector of a solid contains every ray that hits the solid. It may contain other
//            rays, so callers compute the intersections.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/sensing/rays/fan.h"

namespace gsv::sensing {

// The part of a fan in which a solid may be: azimuths between `from` and `to`, or all azimuths.
struct Sector {
  double nearest = 0;       // distance from the fan's origin to the solid's box, m
  double from = 0, to = 0;  // rad; `to` is not less than `from`
  bool is_all = false;  // whether every ray may hit the solid; `from` and `to` then have no meaning
};

// Boxes in their own frames, and the poses of the world in these frames, as a structure of arrays.
struct BoxBatch {
  static constexpr std::size_t kMax = 64;
  using Lanes = std::array<double, kMax>;

  std::size_t count = 0;
  alignas(32) Lanes x, y, z, qw, qx, qy, qz;  // box_from_world
  alignas(32) Lanes min_x, min_y, min_z, max_x, max_y, max_z;

  // Adds a box. The batch must have space for it.
  void Add(const geometry::Pose& box_from_world, const geometry::Bounds& box) {
    const auto& [position, orientation] = box_from_world;
    x[count] = position.x, y[count] = position.y, z[count] = position.z;
    qw[count] = orientation.w, qx[count] = orientation.x;
    qy[count] = orientation.y, qz[count] = orientation.z;
    min_x[count] = box.min.x, min_y[count] = box.min.y, min_z[count] = box.min.z;
    max_x[count] = box.max.x, max_y[count] = box.max.y, max_z[count] = box.max.z;
    ++count;
  }

  // Repeats the last box until the number of boxes is a multiple of four, and returns this number.
  // The repeated boxes do not count.
  std::size_t Pad() {
    const std::size_t end = (count + 3) / 4 * 4;
    for (std::size_t i = count; i < end; ++i) {
      for (Lanes* lanes :
           {&x, &y, &z, &qw, &qx, &qy, &qz, &min_x, &min_y, &min_z, &max_x, &max_y, &max_z}) {
        (*lanes)[i] = (*lanes)[count - 1];
      }
    }
    return end;
  }
};

// The sectors of the boxes of a batch.
struct SectorBatch {
  static constexpr double kNone = 0, kSome = 1, kAll = 2;  // which rays may hit the box

  alignas(32) BoxBatch::Lanes nearest, from, to;  // see Sector
  alignas(32) BoxBatch::Lanes kind;

  // Returns the sector of box i; nothing if no ray passes near it.
  std::optional<Sector> At(std::size_t i) const {
    if (kind[i] == kNone) return std::nullopt;
    return Sector{nearest[i], from[i], to[i], kind[i] == kAll};
  }
};

// Computes the sectors of boxes, and pads the batch. On processors with AVX2, four boxes are
// computed at a time.
void FindSectors(const Fan& fan, BoxBatch& boxes, SectorBatch& sectors);

// The smallest whole number that is at least x. Unlike std::ceil(), it needs no call.
inline double Ceiling(double x) {
  if (!(std::abs(x) < 1e9)) return std::ceil(x);
  const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole < x ? whole + 1 : whole;
}

// Calls visit(first, last) for each run of rays in a sector. Each ray of the sector is in exactly
// one run.
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
  double from = sector.from + kTurn * Ceiling((fan.first - sector.to - slack) * (1 / kTurn));
  for (; from <= last + slack; from += kTurn) {
    const double begin = Ceiling((from - fan.first) / fan.step - kRounding);
    const double end = -Ceiling(-((from + width - fan.first) / fan.step + kRounding));
    const auto low = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(begin));
    const auto high = std::min<std::ptrdiff_t>(count - 1, static_cast<std::ptrdiff_t>(end));
    if (low <= high) visit(static_cast<std::size_t>(low), static_cast<std::size_t>(high));
  }
}

}  // namespace gsv::sensing
