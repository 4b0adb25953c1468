#include "gsv/sensing/rays/candidate_set.h"

#include <immintrin.h>

#ifdef __AVX__
#error "the versions for processors with and without AVX2 are chosen at run time"
#endif

namespace gsv::sensing {
namespace {

// The rays of a packet relative to a place, in single precision.
struct Rays {
  alignas(32) std::array<float, RayPacket::kMax> ox, oy, oz, dx, dy, dz, length;

  Rays(const RayPacket& rays, const geometry::Vector3& place) {
    for (std::size_t i = 0; i < RayPacket::kMax; ++i) {
      ox[i] = static_cast<float>(rays.origin_x[i] - place.x);
      oy[i] = static_cast<float>(rays.origin_y[i] - place.y);
      oz[i] = static_cast<float>(rays.origin_z[i] - place.z);
      dx[i] = static_cast<float>(rays.direction_x[i]);
      dy[i] = static_cast<float>(rays.direction_y[i]);
      dz[i] = static_cast<float>(rays.direction_z[i]);
      length[i] = static_cast<float>(rays.max_distance[i]);
    }
  }
};

// The spheres of the candidates relative to the place, as a structure of arrays.
struct Spheres {
  const float *x, *y, *z, *squared_radius;
  std::size_t count;
};

// Both versions set masks[i] to the rays that pass within the radius of sphere i, like Find().
__attribute__((target("avx2"))) void FindTouchedByAvx2(const Rays& rays, const Spheres& spheres,
                                                       unsigned* masks) {
  const __m256 ox = _mm256_load_ps(rays.ox.data()), oy = _mm256_load_ps(rays.oy.data());
  const __m256 oz = _mm256_load_ps(rays.oz.data()), dx = _mm256_load_ps(rays.dx.data());
  const __m256 dy = _mm256_load_ps(rays.dy.data()), dz = _mm256_load_ps(rays.dz.data());
  const __m256 length = _mm256_load_ps(rays.length.data()), zero = _mm256_setzero_ps();
  for (std::size_t i = 0; i < spheres.count; ++i) {
    const __m256 x = _mm256_set1_ps(spheres.x[i]) - ox, y = _mm256_set1_ps(spheres.y[i]) - oy;
    const __m256 z = _mm256_set1_ps(spheres.z[i]) - oz;
    const __m256 along = _mm256_min_ps(_mm256_max_ps(x * dx + y * dy + z * dz, zero), length);
    const __m256 gap_x = x - along * dx, gap_y = y - along * dy, gap_z = z - along * dz;
    const __m256 gap = gap_x * gap_x + gap_y * gap_y + gap_z * gap_z;
    const __m256 is_near =
        _mm256_cmp_ps(gap, _mm256_set1_ps(spheres.squared_radius[i]), _CMP_LE_OQ);
    masks[i] = static_cast<unsigned>(_mm256_movemask_ps(is_near));
  }
}

void FindTouchedBySse(const Rays& rays, const Spheres& spheres, unsigned* masks) {
  for (std::size_t i = 0; i < spheres.count; ++i) {
    masks[i] = 0;
    const __m128 cx = _mm_set1_ps(spheres.x[i]), cy = _mm_set1_ps(spheres.y[i]);
    const __m128 cz = _mm_set1_ps(spheres.z[i]), most = _mm_set1_ps(spheres.squared_radius[i]);
    for (std::size_t at = 0; at < RayPacket::kMax; at += 4) {
      const __m128 dx = _mm_load_ps(&rays.dx[at]), dy = _mm_load_ps(&rays.dy[at]);
      const __m128 dz = _mm_load_ps(&rays.dz[at]);
      const __m128 x = cx - _mm_load_ps(&rays.ox[at]), y = cy - _mm_load_ps(&rays.oy[at]);
      const __m128 z = cz - _mm_load_ps(&rays.oz[at]);
      const __m128 along = _mm_min_ps(_mm_max_ps(x * dx + y * dy + z * dz, _mm_setzero_ps()),
                                      _mm_load_ps(&rays.length[at]));
      const __m128 gap_x = x - along * dx, gap_y = y - along * dy, gap_z = z - along * dz;
      const __m128 gap = gap_x * gap_x + gap_y * gap_y + gap_z * gap_z;
      masks[i] |= static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(gap, most))) << at;
    }
  }
}

}  // namespace

std::size_t CandidateSet::FindTouched(const RayPacket& packet,
                                      std::array<Touched, kMax>& touched) const {
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  const Rays rays(packet, place_);
  const Spheres spheres{x_.data(), y_.data(), z_.data(), squared_radius_.data(), count_};
  std::array<unsigned, kMax> masks;
  (has_avx2 ? FindTouchedByAvx2 : FindTouchedBySse)(rays, spheres, masks.data());
  const unsigned used = (1u << packet.count) - 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    touched[count] = {numbers_[i], masks[i] & used};
    count += touched[count].rays != 0;
  }
  return count;
}

void CandidateSet::Begin(const geometry::Vector3& place, double reach) {
  place_ = place;
  reach_ = reach;
  count_ = 0;
  is_overfull_ = false;
}

bool CandidateSet::Finish() {
  for (std::size_t i = count_; i % 4 != 0; ++i) {
    x_[i] = y_[i] = z_[i] = 0;
    squared_radius_[i] = -1;
  }
  return !is_overfull_;
}

}  // namespace gsv::sensing
