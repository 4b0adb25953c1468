#include "gsv/sensing/rays/ray_pairs.h"

#include <type_traits>

#include "gsv/sensing/rays/ray_lanes.h"

namespace gsv::sensing {
namespace {

static_assert(RayPairs::kMax % kLanes == 0);

// Moved(poses, rays)
GSV_AVX2_INLINE void MoveRays(const PoseLanes<RayPairs::kMax>& poses, std::size_t first,
                              Vectors& origins, Vectors& directions) {
  const Vectors u{_mm256_load_pd(&poses.qx[first]), _mm256_load_pd(&poses.qy[first]),
                  _mm256_load_pd(&poses.qz[first])};
  const __m256d w = _mm256_load_pd(&poses.qw[first]);
  const Vectors rotated = Rotated(w, u, origins);
  origins = {_mm256_load_pd(&poses.x[first]) + rotated.x,
             _mm256_load_pd(&poses.y[first]) + rotated.y,
             _mm256_load_pd(&poses.z[first]) + rotated.z};
  directions = Rotated(w, u, directions);
}

}  // namespace

bool RayPairs::AreFast() { return HasAvx2(); }

template <class Shape, bool kHaveParts>
GSV_AVX2 void RayPairs::Cast() {
  for (std::size_t first = 0; first < count_; first += kLanes) {
    Vectors origins{_mm256_load_pd(&ox_[first]), _mm256_load_pd(&oy_[first]),
                    _mm256_load_pd(&oz_[first])};
    Vectors directions{_mm256_load_pd(&dx_[first]), _mm256_load_pd(&dy_[first]),
                       _mm256_load_pd(&dz_[first])};
    if (kHaveParts) MoveRays(parts_, first, origins, directions);
    MoveRays(shapes_, first, origins, directions);
    const __m256d x = _mm256_load_pd(&size_x_[first]), z = _mm256_load_pd(&size_z_[first]);
    Spans spans = SlabSpans(origins.z, directions.z, z);
    if constexpr (std::is_same_v<Shape, geometry::Cylinder>) {
      spans = Intersection(PipeSpans(origins, directions, x), spans);
    } else {
      const __m256d y = _mm256_load_pd(&size_y_[first]);
      spans = Intersection(Intersection(SlabSpans(origins.x, directions.x, x),
                                        SlabSpans(origins.y, directions.y, y)),
                           spans);
    }
    _mm256_store_pd(&distances_[first], DistancesIn(spans));
  }
}

template void RayPairs::Cast<geometry::Box, true>();
template void RayPairs::Cast<geometry::Box, false>();
template void RayPairs::Cast<geometry::Cylinder, true>();
template void RayPairs::Cast<geometry::Cylinder, false>();

}  // namespace gsv::sensing
