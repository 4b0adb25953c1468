#include "gsv/sensing/rays/ray_row.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "gsv/base/check.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/ray_lanes.h"
#include "gsv/sensing/rays/ray_shape.h"

namespace gsv::sensing {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

// A rotation in all lanes.
struct Rotations {
  __m256d w;
  Vectors u;
};

GSV_AVX2_INLINE Rotations AllRotate(const Quaternion& q) {
  return {All(q.w), {All(q.x), All(q.y), All(q.z)}};
}

}  // namespace

RayRow::RayRow(const Fan& fan)
    : origin_(fan.world_from_fan.position),
      max_distance_(fan.max_distance),
      size_(fan.directions.size()),
      groups_(std::make_unique_for_overwrite<Group[]>((size_ + kGroup - 1) / kGroup)) {
  static_assert(kGroup == kLanes);
  const std::span<const Vector3> directions = fan.directions;
  for (std::size_t first = 0; first < size_; first += kGroup) {
    Group& group = groups_[first / kGroup];
    for (std::size_t i = 0; i < kGroup; ++i) {
      const Vector3& direction = directions[std::min(first + i, size_ - 1)];
      group.x[i] = direction.x, group.y[i] = direction.y, group.z[i] = direction.z;
      group.range[i] = geometry::kInfinity;
    }
  }
  if (HasAvx2()) {
    Rotate(fan.world_from_fan.orientation);
    return;
  }
  for (std::size_t i = 0; i < (size_ + kGroup - 1) / kGroup * kGroup; ++i) {
    const Vector3 direction = fan.world_from_fan.orientation * Direction(i);
    Group& group = groups_[i / kGroup];
    group.x[i % kGroup] = direction.x, group.y[i % kGroup] = direction.y;
    group.z[i % kGroup] = direction.z;
  }
}

GSV_AVX2 void RayRow::Rotate(const Quaternion& rotation) {
  const Rotations all = AllRotate(rotation);
  for (std::size_t first = 0; first < size_; first += kGroup) {
    Group& group = groups_[first / kGroup];
    const Vectors rotated = Rotated(all.w, all.u,
                                    {_mm256_load_pd(group.x.data()), _mm256_load_pd(group.y.data()),
                                     _mm256_load_pd(group.z.data())});
    _mm256_store_pd(group.x.data(), rotated.x);
    _mm256_store_pd(group.y.data(), rotated.y);
    _mm256_store_pd(group.z.data(), rotated.z);
  }
}

world::Ray RayRow::At(std::size_t i) const {
  return {origin_, Direction(i), std::min(max_distance_, range(i))};
}

void RayRow::CastEachAt(const geometry::Shape& shape, const ShapeFrame& frame, double nearest,
                        std::size_t first, std::size_t last) {
  for (std::size_t i = first; i <= last; ++i) {
    if (range(i) < nearest) continue;
    world::Ray ray = At(i);
    ray.origin = frame.origin;
    for (const Quaternion& rotation : frame.rotations) ray.direction = rotation * ray.direction;
    if (const auto distance = DistanceToShape(ray, shape)) SetRange(i, *distance);
  }
}

template <std::size_t kRotations, class Convex>
GSV_AVX2 void RayRow::CastGroupsRotated(const Convex& shape, const ShapeFrame& frame,
                                        double nearest, std::size_t first, std::size_t last) {
  const Vectors origins{All(frame.origin.x), All(frame.origin.y), All(frame.origin.z)};
  const __m256d max_distances = All(max_distance_), nearests = All(nearest);
  std::array<Rotations, kRotations> rotations;
  for (std::size_t i = 0; i < kRotations; ++i) rotations[i] = AllRotate(frame.rotations[i]);
  for (std::size_t g = first / kGroup; g <= last / kGroup; ++g) {
    Group& group = groups_[g];
    const __m256d ranges = _mm256_load_pd(group.range.data());
    if (_mm256_movemask_pd(_mm256_cmp_pd(ranges, nearests, _CMP_LT_OQ)) == 0xf) continue;
    Vectors directions{_mm256_load_pd(group.x.data()), _mm256_load_pd(group.y.data()),
                       _mm256_load_pd(group.z.data())};
    for (const Rotations& each : rotations) directions = Rotated(each.w, each.u, directions);
    Spans spans;
    if constexpr (std::is_same_v<Convex, geometry::Cylinder>) {
      spans = Intersection(PipeSpans(origins, directions, All(shape.radius)),
                           SlabSpans(origins.z, directions.z, All(shape.length / 2)));
    } else {
      const Vector3 half = 0.5 * shape.size;
      spans = Intersection(Intersection(SlabSpans(origins.x, directions.x, All(half.x)),
                                        SlabSpans(origins.y, directions.y, All(half.y))),
                           SlabSpans(origins.z, directions.z, All(half.z)));
    }
    const __m256d distances = DistancesIn(spans);
    const __m256d counts = _mm256_and_pd(_mm256_cmp_pd(distances, max_distances, _CMP_LE_OQ),
                                         _mm256_cmp_pd(distances, ranges, _CMP_LT_OQ));
    _mm256_store_pd(group.range.data(), _mm256_blendv_pd(ranges, distances, counts));
  }
}

template <class Convex>
void RayRow::CastGroupsAt(const Convex& shape, const ShapeFrame& frame, double nearest,
                          std::size_t first, std::size_t last) {
  if (frame.rotations.size() == 1) {
    CastGroupsRotated<1>(shape, frame, nearest, first, last);
  } else {
    GSV_CHECK(frame.rotations.size() == 2);
    CastGroupsRotated<2>(shape, frame, nearest, first, last);
  }
}

void RayRow::CastAt(const geometry::Shape& shape, const ShapeFrame& frame, double nearest,
                    std::size_t first, std::size_t last) {
  if (HasAvx2()) {
    if (const auto* const box = std::get_if<geometry::Box>(&shape)) {
      return CastGroupsAt(*box, frame, nearest, first, last);
    }
    if (const auto* const cylinder = std::get_if<geometry::Cylinder>(&shape)) {
      return CastGroupsAt(*cylinder, frame, nearest, first, last);
    }
  }
  CastEachAt(shape, frame, nearest, first, last);
}

}  // namespace gsv::sensing
