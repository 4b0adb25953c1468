// The rays of a fan, cast at one solid after another.
//
// Exactness  the ranges are bit-identical to the distances of single rays: DistanceToShape().
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gsv/sensing/rays/fan.h"
#include "gsv/sensing/rays/ray_shape.h"

namespace gsv::sensing {

struct RayRow {
  // Functions may compute this number of rays beyond the last one.
  static constexpr std::size_t kPadding = 8;

  explicit RayRow(const Fan& fan);

  Ray At(std::size_t i) const { return {origin, {x[i], y[i], z[i]}, max_distance}; }

  geometry::Vector3 origin;
  double max_distance;  // m
  std::size_t count;
  std::vector<double> x, y, z;  // directions in the world
  std::vector<double> ranges;   // distances to the nearest solid; infinite if none was found, m
};

// The place of a shape: the rays' origin in its frame, and the rotations that take directions from
// the world to its frame, the first one first.
struct ShapeFrame {
  geometry::Vector3 origin;
  std::span<const geometry::Quaternion> rotations;
};

// Casts rays `first` to `last` at a shape whose points are at least `nearest` away. Other rays may
// be cast at it as well. A Mesh is not allowed.
void CastAtShape(const geometry::Shape& shape, const ShapeFrame& frame, double nearest,
                 std::size_t first, std::size_t last, RayRow& row);

}  // namespace gsv::sensing
