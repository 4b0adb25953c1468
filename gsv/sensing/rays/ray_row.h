// The rays of a fan as a structure of arrays, and for each ray the distance to the nearest surface.
//
// Exactness  distances are bit-identical to the distances of single rays. On processors with AVX2,
//            distances to boxes and cylinders are computed for four rays at once.
// Threads    none; each thread has its own rows.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "gsv/geometry/pose.h"
#include "gsv/geometry/shape.h"
#include "gsv/sensing/rays/fan.h"
#include "gsv/world/ray_caster.h"

namespace gsv::sensing {

// The origin of a row's rays in a shape's frame, and the rotation of directions into this frame.
struct ShapeFrame {
  geometry::Vector3 origin;  // origin of the rays in the shape's frame
  // Rotations of directions from the world to the shape's frame, in the order in which they are
  // applied. Static shapes have one rotation. Shapes of parts have two: of the part and of the
  // shape.
  std::span<const geometry::Quaternion> rotations;
};

// Rays from one point. The rays' ranges are infinite at first.
class RayRow {
 public:
  // The ranges of rays whose values are not finite stay infinite.
  explicit RayRow(const Fan& fan);

  std::size_t size() const { return size_; }
  const geometry::Vector3& origin() const { return origin_; }

  // The range of ray i: the distance to the nearest surface found so far, m; infinite if none.
  double range(std::size_t i) const { return groups_[i / kGroup].range[i % kGroup]; }
  // Sets the range of ray i, m.
  void SetRange(std::size_t i, double range) { groups_[i / kGroup].range[i % kGroup] = range; }

  // Ray i in the world, up to the nearest surface found so far.
  world::Ray At(std::size_t i) const;

  // Casts the rays from `first` to `last` at a shape. A ray is left out if its range is shorter
  // than `nearest`. The distance to the shape must not be shorter than `nearest`.
  void CastAt(const geometry::Shape& shape, const ShapeFrame& frame, double nearest,
              std::size_t first, std::size_t last);

 private:
  static constexpr std::size_t kGroup = 4;
  // Four rays.
  struct alignas(32) Group {
    std::array<double, kGroup> x, y, z;  // directions in the world, unit length
    std::array<double, kGroup> range;    // m
  };

  // Returns the direction of ray i.
  geometry::Vector3 Direction(std::size_t i) const {
    const Group& at = groups_[i / kGroup];
    return {at.x[i % kGroup], at.y[i % kGroup], at.z[i % kGroup]};
  }
  void Rotate(const geometry::Quaternion& rotation);
  // Casts the rays from `first` to `last` one by one.
  void CastEachAt(const geometry::Shape& shape, const ShapeFrame& frame, double nearest,
                  std::size_t first, std::size_t last);
  template <class Convex>
  void CastGroupsAt(const Convex& shape, const ShapeFrame& frame, double nearest, std::size_t first,
                    std::size_t last);
  template <std::size_t kRotations, class Convex>
  void CastGroupsRotated(const Convex& shape, const ShapeFrame& frame, double nearest,
                         std::size_t first, std::size_t last);

  geometry::Vector3 origin_;  // in the world
  double max_distance_;       // length of the rays, m
  std::size_t size_;          // number of rays
  // Unused places in the last group hold copies of the last ray.
  std::unique_ptr<Group[]> groups_;
};

}  // namespace gsv::sensing
