// Distances of several rays to a shape at once. Ray i is element i of every array.
//
// Exactness  the functions compute the operations of DistanceToShape() in the same order, so that
//            the distances are bit-identical. They compute both cases of a branch and then select
//            one. The compiler turns their loops into vector instructions, if the file is compiled
//            without errno and traps.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "gsv/geometry/constants.h"
#include "gsv/geometry/pose.h"
#include "gsv/geometry/shape.h"

namespace gsv::sensing {

template <std::size_t kCount>
struct alignas(32) Lanes {
  std::array<double, kCount> values;
  double operator[](std::size_t i) const { return values[i]; }
  double& operator[](std::size_t i) { return values[i]; }
};

// A coordinate that all rays share.
struct Shared {
  double value;
  double operator[](std::size_t) const { return value; }
};

// Directions, or origins, of rays.
template <std::size_t kCount>
struct LaneVectors {
  Lanes<kCount> x, y, z;
};
struct SharedVector {
  Shared x, y, z;
};

// The intervals of the rays inside a convex solid; empty if `enter` is beyond `leave`.
template <std::size_t kCount>
struct LaneSpans {
  Lanes<kCount> enter, leave;
};

// Rotates directions like `rotation * direction`.
template <std::size_t kCount>
[[gnu::always_inline]] inline void Rotate(const geometry::Quaternion& rotation,
                                          LaneVectors<kCount>& directions) {
  const double w = rotation.w, ux = rotation.x, uy = rotation.y, uz = rotation.z;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kCount; ++i) {
    const double vx = directions.x[i], vy = directions.y[i], vz = directions.z[i];
    const double cx = (uy * vz - uz * vy) + vx * w;
    const double cy = (uz * vx - ux * vz) + vy * w;
    const double cz = (ux * vy - uy * vx) + vz * w;
    directions.x[i] = vx + (uy * cz - uz * cy) * 2.0;
    directions.y[i] = vy + (uz * cx - ux * cz) * 2.0;
    directions.z[i] = vz + (ux * cy - uy * cx) * 2.0;
  }
}

// Returns the spans between the planes at ±half along one axis.
template <std::size_t kCount, class Origins>
[[gnu::always_inline]] inline LaneSpans<kCount> SlabSpans(const Origins& origins,
                                                          const Lanes<kCount>& directions,
                                                          double half) {
  LaneSpans<kCount> spans;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kCount; ++i) {
    const double origin = origins[i], direction = directions[i];
    const double to_low = (-half - origin) / direction, to_high = (half - origin) / direction;
    const double enter = direction > 0 ? to_low : to_high;
    const double leave = direction > 0 ? to_high : to_low;
    const double leave_if_level =
        std::abs(origin) <= half ? geometry::kInfinity : -geometry::kInfinity;
    spans.enter[i] = direction == 0 ? -leave_if_level : enter;
    spans.leave[i] = direction == 0 ? leave_if_level : leave;
  }
  return spans;
}

// Returns the spans inside the infinite cylinder about z. Products with the zero z coordinates are
// kept, because they affect the results of numbers that are not finite.
template <std::size_t kCount, class Origins>
[[gnu::always_inline]] inline LaneSpans<kCount> PipeSpans(const Origins& origins,
                                                          const LaneVectors<kCount>& directions,
                                                          double radius) {
  LaneSpans<kCount> spans;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kCount; ++i) {
    const double ox = origins.x[i], oy = origins.y[i];
    const double dx = directions.x[i], dy = directions.y[i];
    const double speed = dx * dx + dy * dy + 0.0 * 0.0;
    const double middle = -(ox * dx + oy * dy + 0.0 * 0.0) / speed;
    const double nx = ox + dx * middle, ny = oy + dy * middle, nz = 0.0 + 0.0 * middle;
    const double squared = radius * radius - (nx * nx + ny * ny + nz * nz);
    const double ratio = squared / speed;
    const double half = std::sqrt(ratio > 0 ? ratio : 0.0);
    const double enter = squared < 0 ? geometry::kInfinity : middle - half;
    const double leave = squared < 0 ? -geometry::kInfinity : middle + half;
    const double leave_if_upright = ox * ox + oy * oy + 0.0 * 0.0 <= radius * radius
                                        ? geometry::kInfinity
                                        : -geometry::kInfinity;
    spans.enter[i] = speed == 0 ? -leave_if_upright : enter;
    spans.leave[i] = speed == 0 ? leave_if_upright : leave;
  }
  return spans;
}

template <std::size_t kCount>
[[gnu::always_inline]] inline LaneSpans<kCount> Intersection(const LaneSpans<kCount>& a,
                                                             const LaneSpans<kCount>& b) {
  LaneSpans<kCount> both;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kCount; ++i) {
    both.enter[i] = a.enter[i] >= b.enter[i] ? a.enter[i] : b.enter[i];
    both.leave[i] = a.leave[i] <= b.leave[i] ? a.leave[i] : b.leave[i];
  }
  return both;
}

// The shapes in their own frames.
template <std::size_t kCount, class Origins>
[[gnu::always_inline]] inline LaneSpans<kCount> SpansThrough(
    const geometry::Box& box, const Origins& origins, const LaneVectors<kCount>& directions) {
  const geometry::Vector3 half = 0.5 * box.size;
  return Intersection(Intersection(SlabSpans(origins.x, directions.x, half.x),
                                   SlabSpans(origins.y, directions.y, half.y)),
                      SlabSpans(origins.z, directions.z, half.z));
}
template <std::size_t kCount, class Origins>
[[gnu::always_inline]] inline LaneSpans<kCount> SpansThrough(
    const geometry::Cylinder& cylinder, const Origins& origins,
    const LaneVectors<kCount>& directions) {
  return Intersection(PipeSpans(origins, directions, cylinder.radius),
                      SlabSpans(origins.z, directions.z, cylinder.length / 2));
}

// Returns the distance at which a ray enters the solid, or leaves it if it begins inside; infinite
// if that is not within `max_distance`.
[[gnu::always_inline]] inline double DistanceIn(double enter, double leave, double max_distance) {
  const double distance = enter >= 0 ? enter : leave;
  const double within = distance <= max_distance ? distance : geometry::kInfinity;
  const double ahead = distance >= 0 ? within : geometry::kInfinity;
  return enter <= leave ? ahead : geometry::kInfinity;
}

}  // namespace gsv::sensing
