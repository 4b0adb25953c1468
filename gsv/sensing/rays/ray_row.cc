#include "gsv/sensing/rays/ray_row.h"

#include <algorithm>
#include <variant>

#include "gsv/base/each_processor.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/ray_lanes.h"

namespace gsv::sensing {
namespace {

using geometry::kInfinity;
using geometry::Quaternion;
using geometry::Vector3;

constexpr std::size_t kLanes = 4;
static_assert(kLanes <= RayRow::kPadding);

// Rays of a row from `begin` to `end`, in whole groups.
struct Run {
  std::size_t begin, end;
  double nearest;
};

[[gnu::always_inline]] inline LaneVectors<kLanes> DirectionsAt(const RayRow& row,
                                                               std::size_t group) {
  LaneVectors<kLanes> directions;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kLanes; ++i) {
    directions.x[i] = row.x[group + i];
    directions.y[i] = row.y[group + i];
    directions.z[i] = row.z[group + i];
  }
  return directions;
}

template <class Shape>
[[gnu::always_inline]] inline void CastAtConvex(const Shape& shape, const ShapeFrame& frame,
                                                const Run& run, RayRow& row) {
  const SharedVector origins{{frame.origin.x}, {frame.origin.y}, {frame.origin.z}};
  const double max_distance = row.max_distance;
  for (std::size_t group = run.begin; group < run.end; group += kLanes) {
    double* const ranges = &row.ranges[group];
    double farthest = ranges[0];
#pragma GCC unroll 1
    for (std::size_t i = 1; i < kLanes; ++i) farthest = std::max(farthest, ranges[i]);
    if (farthest < run.nearest) continue;
    LaneVectors<kLanes> directions = DirectionsAt(row, group);
    for (const Quaternion& rotation : frame.rotations) Rotate(rotation, directions);
    const LaneSpans<kLanes> spans = SpansThrough(shape, origins, directions);
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double distance = DistanceIn(spans.enter[i], spans.leave[i], max_distance);
      ranges[i] = distance < ranges[i] ? distance : ranges[i];
    }
  }
}

GSV_FOR_EACH_PROCESSOR
void CastAtBox(const geometry::Box& box, const ShapeFrame& frame, const Run& run, RayRow& row) {
  CastAtConvex(box, frame, run, row);
}

GSV_FOR_EACH_PROCESSOR
void CastAtCylinder(const geometry::Cylinder& cylinder, const ShapeFrame& frame, const Run& run,
                    RayRow& row) {
  CastAtConvex(cylinder, frame, run, row);
}

GSV_FOR_EACH_PROCESSOR
void RotateAll(const Quaternion& rotation, RayRow& row) {
  for (std::size_t group = 0; group < row.count; group += kLanes) {
    LaneVectors<kLanes> directions = DirectionsAt(row, group);
    Rotate(rotation, directions);
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kLanes; ++i) {
      row.x[group + i] = directions.x[i];
      row.y[group + i] = directions.y[i];
      row.z[group + i] = directions.z[i];
    }
  }
}

}  // namespace

RayRow::RayRow(const Fan& fan)
    : origin(fan.world_from_fan.position),
      max_distance(fan.max_distance),
      count(fan.directions.size()),
      x(count + kPadding),
      y(count + kPadding),
      z(count + kPadding),
      ranges(count + kPadding, kInfinity) {
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = fan.directions[i].x, y[i] = fan.directions[i].y, z[i] = fan.directions[i].z;
  }
  RotateAll(fan.world_from_fan.orientation, *this);
}

void CastAtShape(const geometry::Shape& shape, const ShapeFrame& frame, double nearest,
                 std::size_t first, std::size_t last, RayRow& row) {
  // Groups begin at multiples of their size, so that the processor need not combine the ranges that
  // it has just written.
  const Run run{first / kLanes * kLanes, last + 1, nearest};
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    return CastAtBox(*box, frame, run, row);
  }
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
    return CastAtCylinder(*cylinder, frame, run, row);
  }
  for (std::size_t i = first; i <= last; ++i) {
    if (row.ranges[i] < nearest) continue;
    Ray ray{frame.origin, row.At(i).direction, std::min(row.max_distance, row.ranges[i])};
    for (const Quaternion& rotation : frame.rotations) ray.direction = rotation * ray.direction;
    row.ranges[i] = DistanceToShape(ray, shape).value_or(row.ranges[i]);
  }
}

}  // namespace gsv::sensing
