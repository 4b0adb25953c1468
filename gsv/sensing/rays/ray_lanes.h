// Intersections of four rays at once, for processors with AVX2. Use these functions only in
// functions with GSV_AVX2, after HasAvx2() returned true.
//
// Exactness  the functions compute the same operations in the same order as the functions for one
//            ray in ray_shape.cc, quaternion.h and vector3.h. So the results are bit-identical. For
//            a branch, both cases are computed, and one is selected.
#pragma once

#include <cstddef>

#include <immintrin.h>

#include "gsv/geometry/constants.h"

#ifdef __AVX__
#error "the versions for processors with and without AVX2 are chosen at run time"
#endif

#define GSV_AVX2 __attribute__((target("avx2")))
#define GSV_AVX2_INLINE __attribute__((target("avx2"), always_inline)) inline

namespace gsv::sensing {

constexpr std::size_t kLanes = 4;

inline bool HasAvx2() {
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  return has_avx2;
}

// Positions or directions.
struct Vectors {
  __m256d x, y, z;
};

// The intervals of lines inside convex solids; empty unless enter <= leave.
struct Spans {
  __m256d enter, leave;
};

// `a ? b : c` is _mm256_blendv_pd(c, b, a).

// Returns the value in all lanes.
GSV_AVX2_INLINE __m256d All(double value) { return _mm256_set1_pd(value); }

// rotation * v
GSV_AVX2_INLINE Vectors Rotated(__m256d w, const Vectors& u, const Vectors& v) {
  const __m256d cx = (u.y * v.z - u.z * v.y) + v.x * w;
  const __m256d cy = (u.z * v.x - u.x * v.z) + v.y * w;
  const __m256d cz = (u.x * v.y - u.y * v.x) + v.z * w;
  const __m256d two = All(2);
  return {v.x + (u.y * cz - u.z * cy) * two, v.y + (u.z * cx - u.x * cz) * two,
          v.z + (u.x * cy - u.y * cx) * two};
}

// Computes Slab<Span>(origin, direction, half) of ray_shape.cc for four rays.
GSV_AVX2_INLINE Spans SlabSpans(__m256d origin, __m256d direction, __m256d half) {
  const __m256d zero = _mm256_setzero_pd(), infinity = All(geometry::kInfinity);
  const __m256d sign = All(-0.0), minus_infinity = All(-geometry::kInfinity);
  const __m256d to_low = (_mm256_xor_pd(half, sign) - origin) / direction;
  const __m256d to_high = (half - origin) / direction;
  const __m256d is_rising = _mm256_cmp_pd(direction, zero, _CMP_GT_OQ);
  const __m256d is_level = _mm256_cmp_pd(direction, zero, _CMP_EQ_OQ);
  const __m256d is_within = _mm256_cmp_pd(_mm256_andnot_pd(sign, origin), half, _CMP_LE_OQ);
  // Used if the ray is parallel to the slab's faces: it is between them everywhere or nowhere.
  const __m256d enter_if_level = _mm256_blendv_pd(infinity, minus_infinity, is_within);
  return {_mm256_blendv_pd(_mm256_blendv_pd(to_high, to_low, is_rising), enter_if_level, is_level),
          _mm256_blendv_pd(_mm256_blendv_pd(to_low, to_high, is_rising),
                           _mm256_xor_pd(enter_if_level, sign), is_level)};
}

// Computes PipeChord<Span>(ray, radius) of ray_shape.cc for four rays. Keeps the products with z
// coordinates of zero, because they matter for infinite and NaN inputs.
GSV_AVX2_INLINE Spans PipeSpans(const Vectors& origins, const Vectors& directions, __m256d radius) {
  const __m256d zero = _mm256_setzero_pd(), infinity = All(geometry::kInfinity);
  const __m256d sign = All(-0.0), minus_infinity = All(-geometry::kInfinity);
  const Vectors &o = origins, &d = directions;
  const __m256d speed = d.x * d.x + d.y * d.y + zero;
  const __m256d middle = _mm256_xor_pd(o.x * d.x + o.y * d.y + zero, sign) / speed;
  const __m256d nx = o.x + d.x * middle, ny = o.y + d.y * middle, nz = zero + zero * middle;
  const __m256d square = radius * radius;
  const __m256d squared = square - (nx * nx + ny * ny + nz * nz);
  const __m256d half = _mm256_sqrt_pd(squared / speed);
  const __m256d misses = _mm256_cmp_pd(squared, zero, _CMP_LT_OQ);
  const __m256d is_upright = _mm256_cmp_pd(speed, zero, _CMP_EQ_OQ);
  const __m256d is_within = _mm256_cmp_pd(o.x * o.x + o.y * o.y + zero, square, _CMP_LE_OQ);
  // Used if the ray is parallel to the pipe's axis (z): it is inside everywhere or nowhere.
  const __m256d enter_if_upright = _mm256_blendv_pd(infinity, minus_infinity, is_within);
  return {_mm256_blendv_pd(_mm256_blendv_pd(middle - half, infinity, misses), enter_if_upright,
                           is_upright),
          _mm256_blendv_pd(_mm256_blendv_pd(middle + half, minus_infinity, misses),
                           _mm256_xor_pd(enter_if_upright, sign), is_upright)};
}

// Intersection(a, b)
GSV_AVX2_INLINE Spans Intersection(const Spans& a, const Spans& b) {
  return {_mm256_blendv_pd(b.enter, a.enter, _mm256_cmp_pd(a.enter, b.enter, _CMP_GE_OQ)),
          _mm256_blendv_pd(b.leave, a.leave, _mm256_cmp_pd(a.leave, b.leave, _CMP_LE_OQ))};
}

// The distance at which a ray enters the solid, or leaves it if it begins inside.
GSV_AVX2_INLINE __m256d DistancesIn(const Spans& spans) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d distance =
      _mm256_blendv_pd(spans.leave, spans.enter, _mm256_cmp_pd(spans.enter, zero, _CMP_GE_OQ));
  const __m256d counts = _mm256_and_pd(_mm256_cmp_pd(spans.enter, spans.leave, _CMP_LE_OQ),
                                       _mm256_cmp_pd(distance, zero, _CMP_GE_OQ));
  return _mm256_blendv_pd(All(geometry::kInfinity), distance, counts);
}

}  // namespace gsv::sensing
