// Vectors of eight numbers with AVX2 and FMA.
//
// Determinism  approximate instructions (reciprocals, inverse roots) are not used, because their
//              results differ between processors of different makers.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace gsv::rendering::raster {

#pragma GCC push_options
#pragma GCC target("avx2,fma")

typedef float F8 __attribute__((vector_size(32)));
// also used as masks, in which a lane has all bits or none
typedef std::int32_t I8 __attribute__((vector_size(32)));

inline F8 Splat(float value) { return _mm256_set1_ps(value); }
inline I8 SplatInt(std::int32_t value) { return (I8)_mm256_set1_epi32(value); }
inline F8 Load(const float* from) { return _mm256_loadu_ps(from); }
inline I8 LoadInt(const void* from) {
  return (I8)_mm256_loadu_si256(static_cast<const __m256i*>(from));
}
inline void Store(float* to, F8 value) { _mm256_storeu_ps(to, value); }
inline void StoreInt(void* to, I8 value) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), (__m256i)value);
}
inline F8 Fma(F8 a, F8 b, F8 c) { return _mm256_fmadd_ps(a, b, c); }  // returns a b + c
inline F8 Min(F8 a, F8 b) { return _mm256_min_ps(a, b); }
inline F8 Max(F8 a, F8 b) { return _mm256_max_ps(a, b); }
inline F8 Clamp01(F8 a) { return Min(Max(a, Splat(0)), Splat(1)); }
inline F8 Sqrt(F8 a) { return _mm256_sqrt_ps(a); }
inline F8 Floor(F8 a) { return _mm256_floor_ps(a); }
inline F8 Ceil(F8 a) { return _mm256_ceil_ps(a); }
inline F8 Abs(F8 a) { return _mm256_andnot_ps(Splat(-0.0f), a); }
inline F8 ToFloat(I8 a) { return _mm256_cvtepi32_ps((__m256i)a); }
inline I8 Truncated(F8 a) { return (I8)_mm256_cvttps_epi32(a); }
inline I8 MinInt(I8 a, I8 b) { return (I8)_mm256_min_epi32((__m256i)a, (__m256i)b); }
inline I8 MaxInt(I8 a, I8 b) { return (I8)_mm256_max_epi32((__m256i)a, (__m256i)b); }
inline F8 Select(I8 mask, F8 a, F8 b) { return _mm256_blendv_ps(b, a, (__m256)mask); }
inline I8 SelectInt(I8 mask, I8 a, I8 b) {
  return (I8)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)mask);
}
// Returns a mask with one bit per lane: bit i is set if lane i of `mask` is set.
inline int Bits(I8 mask) { return _mm256_movemask_ps((__m256)mask); }
inline F8 Gather(const float* from, I8 index) {
  return _mm256_i32gather_ps(from, (__m256i)index, 4);
}
inline I8 GatherInt(const void* from, I8 index) {
  return (I8)_mm256_i32gather_epi32(static_cast<const int*>(from), (__m256i)index, 4);
}
struct I8x2 {
  I8 first, second;
};
// Loads from[index] and from[index + 1], with half the loads of two gathers.
inline I8x2 GatherPairs(const void* from, I8 index) {
  // Loads the pairs of lanes 0, 1, 4, 5 into `low`, and those of lanes 2, 3, 6, 7 into `high`. The
  // shuffles below work within each half of a register, so they then give the order 0 to 7.
  const __m256i halves = _mm256_permute4x64_epi64((__m256i)index, 0xd8);
  const auto gather = [&](__m128i four) {
    return _mm256_castsi256_ps(
        _mm256_i32gather_epi64(static_cast<const long long*>(from), four, 4));
  };
  const __m256 low = gather(_mm256_castsi256_si128(halves));
  const __m256 high = gather(_mm256_extracti128_si256(halves, 1));
  return {(I8)_mm256_shuffle_ps(low, high, 0x88), (I8)_mm256_shuffle_ps(low, high, 0xdd)};
}
// Loads the byte from[index] for each lane. Reads up to three bytes beyond each element.
inline I8 GatherByte(const std::uint8_t* from, I8 index) {
  return (I8)_mm256_i32gather_epi32(reinterpret_cast<const int*>(from), (__m256i)index, 1) &
         SplatInt(0xff);
}
inline F8 Steps() { return F8{0, 1, 2, 3, 4, 5, 6, 7}; }
inline I8 IntSteps() { return I8{0, 1, 2, 3, 4, 5, 6, 7}; }

struct F8x3 {
  F8 x, y, z;
};
inline F8x3 Splat(float x, float y, float z) { return {Splat(x), Splat(y), Splat(z)}; }
inline F8x3 operator+(const F8x3& a, const F8x3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline F8x3 operator-(const F8x3& a, const F8x3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline F8x3 operator*(const F8x3& a, F8 k) { return {a.x * k, a.y * k, a.z * k}; }
inline F8x3 operator*(const F8x3& a, const F8x3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline F8x3 Fma(const F8x3& a, F8 k, const F8x3& c) {
  return {Fma(a.x, k, c.x), Fma(a.y, k, c.y), Fma(a.z, k, c.z)};
}
inline F8 Dot(const F8x3& a, const F8x3& b) { return Fma(a.x, b.x, Fma(a.y, b.y, a.z * b.z)); }
inline F8x3 Normalized(const F8x3& a) {
  return a * (Splat(1) / Sqrt(Max(Dot(a, a), Splat(1e-30f))));
}
inline F8x3 Select(I8 mask, const F8x3& a, const F8x3& b) {
  return {Select(mask, a.x, b.x), Select(mask, a.y, b.y), Select(mask, a.z, b.z)};
}

#pragma GCC pop_options

}  // namespace gsv::rendering::raster
