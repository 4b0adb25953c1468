// Vectors of eight numbers with AVX2 and FMA, and of sixteen numbers with AVX-512.
//
// Functions have the same names for both. Only pixel_loops_16.cc uses vectors of sixteen numbers. It is
// compiled with AVX-512, and HasSixteenLanes() says whether the processor has it.
//
// Determinism  approximate instructions (reciprocals, inverse roots) are not used, because their
//              results differ between processors of different makers. Results do not depend on the
//              number of lanes.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace gsv::rendering::raster {

#pragma GCC push_options
#pragma GCC target("avx2,fma")

typedef float F4 __attribute__((vector_size(16)));
typedef float F8 __attribute__((vector_size(32)));
// also used as masks, in which a lane has all bits or none
typedef std::int32_t I8 __attribute__((vector_size(32)));

// The types that belong to a vector of floats. Its lanes are one or two groups of eight.
template <class F>
struct Lanes;
template <>
struct Lanes<F8> {
  using Ints = I8;
  using Mask = I8;
  static constexpr int kCount = 8, kGroups = 1;
};

// Returns a vector with this number in all lanes.
template <class F>
F Splat(float value);
template <class F>
typename Lanes<F>::Ints SplatInt(std::int32_t value);
// Returns 0 to 7, in each group of eight lanes.
template <class F>
F Steps();
template <class F>
typename Lanes<F>::Ints IntSteps();
// Returns a vector in which all lanes of a group have the value of this group.
template <class F>
F SplatGroups(const float (&values)[Lanes<F>::kGroups]);
// Returns a vector in which all lanes of the n-th group have the value of lane `first` + n.
template <class F>
F FromLanes(F8 values, int first);
template <class F>
typename Lanes<F>::Ints FromLanes(I8 values, int first) {
  return (typename Lanes<F>::Ints)FromLanes<F>((F8)values, first);
}
// Returns a vector with the value of the n-th group in lane n.
template <class F>
F8 OfGroups(const float (&values)[Lanes<F>::kGroups]);
// The places of the groups of a vector in an array: each has eight elements from this index on.
template <class F>
struct Places {
  std::size_t of[Lanes<F>::kGroups];
};
// Loads the elements of all groups.
template <class F>
F LoadGroups(const float* from, const Places<F>& at);
template <class F>
typename Lanes<F>::Ints LoadGroupInts(const std::uint32_t* from, const Places<F>& at);

template <>
inline F8 Splat<F8>(float value) {
  return _mm256_set1_ps(value);
}
template <>
inline I8 SplatInt<F8>(std::int32_t value) {
  return (I8)_mm256_set1_epi32(value);
}
inline F8 Splat(float value) { return Splat<F8>(value); }
inline I8 SplatInt(std::int32_t value) { return SplatInt<F8>(value); }
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
inline I8 Less(F8 a, F8 b) { return a < b; }
inline I8 AtLeast(F8 a, F8 b) { return a >= b; }
inline I8 EqualInt(I8 a, I8 b) { return a == b; }
// Returns a mask with one bit per lane: bit i is set if lane i of `mask` is set.
inline int Bits(I8 mask) { return _mm256_movemask_ps((__m256)mask); }
inline F8 Gather(const float* from, I8 index) {
  return _mm256_i32gather_ps(from, (__m256i)index, 4);
}
// The shuffle that moves byte K of each of four elements to its lowest byte, and clears the others.
template <int K>
__m128i ByteOrder() {
  return _mm_setr_epi8(K, -1, -1, -1, K + 4, -1, -1, -1, K + 8, -1, -1, -1, K + 12, -1, -1, -1);
}
// Returns byte K of each element; byte 0 is the lowest.
template <int K>
I8 Byte(I8 a) {
  return (I8)_mm256_shuffle_epi8((__m256i)a, _mm256_broadcastsi128_si256(ByteOrder<K>()));
}
// Returns the eight bytes at from[index[i]] for the four elements of `index`. An element of `from`
// has four bytes. On AMD's Zen 4, 16 lanes are loaded so in two thirds of the time of a gather,
// and 8 lanes in the same time.
inline __m256i FourPairs(const void* from, const std::int32_t* index) {
  const auto pair = [&](int i) {
    return reinterpret_cast<const double*>(static_cast<const std::int32_t*>(from) + index[i]);
  };
  const auto two = [&](int i) {
    return _mm_castpd_si128(_mm_loadh_pd(_mm_load_sd(pair(i)), pair(i + 1)));
  };
  return _mm256_inserti128_si256(_mm256_castsi128_si256(two(0)), two(2), 1);
}
struct I8x2 {
  I8 first, second;
};
// Loads from[index] and from[index + 1].
inline I8x2 GatherPairs(const void* from, I8 index) {
  // Loads the pairs of lanes 0, 1, 4, 5 into `low`, and those of lanes 2, 3, 6, 7 into `high`. The
  // shuffles below work within each half of a register, so they then give the order 0 to 7.
  alignas(32) std::int32_t at[8];
  StoreInt(at, (I8)_mm256_permute4x64_epi64((__m256i)index, 0xd8));
  const __m256 low = _mm256_castsi256_ps(FourPairs(from, at));
  const __m256 high = _mm256_castsi256_ps(FourPairs(from, at + 4));
  return {(I8)_mm256_shuffle_ps(low, high, 0x88), (I8)_mm256_shuffle_ps(low, high, 0xdd)};
}
// Returns table[index] for each lane, without gathering.
template <class F>
F FromTable(const float (&table)[16], typename Lanes<F>::Ints index);
template <class F>
typename Lanes<F>::Ints FromTable(const std::int32_t (&table)[16], typename Lanes<F>::Ints index);
template <>
inline F8 FromTable<F8>(const float (&table)[16], I8 index) {
  const auto half = [&](int first) {
    return _mm256_permutevar8x32_ps(Load(table + first), (__m256i)index);
  };
  return Select(index < SplatInt(8), half(0), half(8));
}
template <>
inline I8 FromTable<F8>(const std::int32_t (&table)[16], I8 index) {
  const auto half = [&](int first) {
    return (I8)_mm256_permutevar8x32_epi32((__m256i)LoadInt(table + first), (__m256i)index);
  };
  return SelectInt(index < SplatInt(8), half(0), half(8));
}
// Loads the byte from[index] for each lane. Reads up to three bytes beyond each element.
inline I8 GatherByte(const std::uint8_t* from, I8 index) {
  return (I8)_mm256_i32gather_epi32(reinterpret_cast<const int*>(from), (__m256i)index, 1) &
         SplatInt(0xff);
}
template <>
inline F8 LoadGroups<F8>(const float* from, const Places<F8>& at) {
  return Load(from + at.of[0]);
}
template <>
inline I8 LoadGroupInts<F8>(const std::uint32_t* from, const Places<F8>& at) {
  return LoadInt(from + at.of[0]);
}
template <>
inline F8 SplatGroups<F8>(const float (&values)[1]) {
  return Splat(values[0]);
}
template <>
inline F8 FromLanes<F8>(F8 values, int first) {
  return _mm256_permutevar8x32_ps(values, (__m256i)SplatInt(first));
}
template <>
inline F8 OfGroups<F8>(const float (&values)[1]) {
  return F8{values[0]};
}
template <>
inline F8 Steps<F8>() {
  return F8{0, 1, 2, 3, 4, 5, 6, 7};
}
template <>
inline I8 IntSteps<F8>() {
  return I8{0, 1, 2, 3, 4, 5, 6, 7};
}
inline F8 Steps() { return Steps<F8>(); }
inline I8 IntSteps() { return IntSteps<F8>(); }
// Whether a lane is set.
inline bool Any(I8 mask) { return Bits(mask) != 0; }
// Returns the mask of which Bits() returns `bits`.
template <class F>
typename Lanes<F>::Mask MaskOf(int bits);
template <>
inline I8 MaskOf<F8>(int bits) {
  const I8 of_lane{1, 2, 4, 8, 16, 32, 64, 128};
  return (SplatInt(bits) & of_lane) == of_lane;
}
// Returns a mask in which all lanes are set if a lane of `mask` is set.
inline I8 AnyOfEight(I8 mask) { return SplatInt(Bits(mask) != 0 ? -1 : 0); }
// Returns a vector in which all lanes of the n-th group of eight lanes have the value of lane n.
template <class F>
F ByGroup(F8 values);
template <>
inline F8 ByGroup<F8>(F8 values) {
  return _mm256_broadcastss_ps(_mm256_castps256_ps128(values));
}
// Stores the elements of those lanes that are set in `mask`. Other threads must not write the other
// lanes' elements.
inline void StoreGroups(I8 mask, float* to, const Places<F8>& at, F8 value) {
  float* place = to + at.of[0];
  Store(place, Select(mask, value, Load(place)));
}
inline void StoreAllGroups(std::uint32_t* to, const Places<F8>& at, I8 value) {
  StoreInt(to + at.of[0], value);
}
inline void StoreGroupInts(I8 mask, std::uint32_t* to, const Places<F8>& at, I8 value) {
  std::uint32_t* place = to + at.of[0];
  StoreInt(place, SelectInt(mask, value, LoadInt(place)));
}
// Returns the highest and the lowest lane.
inline float MaxOf(F8 a) {
  F4 b = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  b = _mm_max_ps(b, _mm_movehl_ps(b, b));
  return _mm_max_ps(b, _mm_movehdup_ps(b))[0];
}
inline float MinOf(F8 a) { return -MaxOf(-a); }
// Returns 2^n.
inline F8 PowerOfTwo(I8 n) { return (F8)_mm256_slli_epi32((__m256i)(n + 127), 23); }

#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512bw,avx512dq,avx512vl")

typedef float F16 __attribute__((vector_size(64)));
typedef std::int32_t I16 __attribute__((vector_size(64)));
struct Mask16 {
  __mmask16 bits;
};
template <>
struct Lanes<F16> {
  using Ints = I16;
  using Mask = Mask16;
  static constexpr int kCount = 16, kGroups = 2;
};

inline Mask16 operator&(Mask16 a, Mask16 b) { return {_kand_mask16(a.bits, b.bits)}; }
inline Mask16 operator|(Mask16 a, Mask16 b) { return {_kor_mask16(a.bits, b.bits)}; }
inline Mask16 operator~(Mask16 a) { return {_knot_mask16(a.bits)}; }
template <>
inline F16 Splat<F16>(float value) {
  return _mm512_set1_ps(value);
}
template <>
inline I16 SplatInt<F16>(std::int32_t value) {
  return (I16)_mm512_set1_epi32(value);
}
template <>
inline F16 Steps<F16>() {
  return F16{0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
}
template <>
inline I16 IntSteps<F16>() {
  return I16{0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
}
template <>
inline F16 LoadGroups<F16>(const float* from, const Places<F16>& at) {
  return _mm512_insertf32x8(_mm512_castps256_ps512(Load(from + at.of[0])), Load(from + at.of[1]),
                            1);
}
template <>
inline I16 LoadGroupInts<F16>(const std::uint32_t* from, const Places<F16>& at) {
  return (I16)_mm512_inserti32x8(_mm512_castsi256_si512((__m256i)LoadInt(from + at.of[0])),
                                 (__m256i)LoadInt(from + at.of[1]), 1);
}
template <>
inline F16 SplatGroups<F16>(const float (&values)[2]) {
  return _mm512_mask_broadcastss_ps(_mm512_set1_ps(values[0]), 0xff00, _mm_set_ss(values[1]));
}
template <>
inline F16 FromLanes<F16>(F8 values, int first) {
  const __m512i group = _mm512_set_epi32(1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0);
  return _mm512_permutexvar_ps(_mm512_add_epi32(_mm512_set1_epi32(first), group),
                               _mm512_castps256_ps512(values));
}
template <>
inline F8 OfGroups<F16>(const float (&values)[2]) {
  return F8{values[0], values[1]};
}
inline F16 Fma(F16 a, F16 b, F16 c) { return _mm512_fmadd_ps(a, b, c); }
inline F16 Min(F16 a, F16 b) { return _mm512_min_ps(a, b); }
inline F16 Max(F16 a, F16 b) { return _mm512_max_ps(a, b); }
inline F16 Sqrt(F16 a) { return _mm512_sqrt_ps(a); }
inline F16 Floor(F16 a) { return _mm512_roundscale_ps(a, _MM_FROUND_TO_NEG_INF); }
inline F16 ToFloat(I16 a) { return _mm512_cvtepi32_ps((__m512i)a); }
inline I16 Truncated(F16 a) { return (I16)_mm512_cvttps_epi32(a); }
inline F16 Select(Mask16 mask, F16 a, F16 b) { return _mm512_mask_blend_ps(mask.bits, b, a); }
inline I16 SelectInt(Mask16 mask, I16 a, I16 b) {
  return (I16)_mm512_mask_blend_epi32(mask.bits, (__m512i)b, (__m512i)a);
}
inline Mask16 Less(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a, b, _CMP_LT_OQ)}; }
inline Mask16 AtLeast(F16 a, F16 b) { return {_mm512_cmp_ps_mask(a, b, _CMP_GE_OQ)}; }
inline Mask16 EqualInt(I16 a, I16 b) { return {_mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b)}; }
// GCC 12 may store a mask as 16 bits and then read 32 bits, so the conversion is explicit.
inline int Bits(Mask16 mask) {
  int bits;
  asm("kmovw %1, %0" : "=r"(bits) : "k"(mask.bits));
  return bits;
}
inline bool Any(Mask16 mask) { return _kortestz_mask16_u8(mask.bits, mask.bits) == 0; }
template <>
inline Mask16 MaskOf<F16>(int bits) {
  return {static_cast<__mmask16>(bits)};
}
template <int K>
I16 Byte(I16 a) {
  return (I16)_mm512_shuffle_epi8((__m512i)a, _mm512_broadcast_i32x4(ByteOrder<K>()));
}
struct I16x2 {
  I16 first, second;
};
inline I16x2 GatherPairs(const void* from, I16 index) {
  alignas(64) std::int32_t at[16];
  _mm512_store_si512(at, (__m512i)index);
  const auto eight = [&](int i) {
    const __m512i four = _mm512_castsi256_si512(FourPairs(from, at + i));
    return _mm512_inserti64x4(four, FourPairs(from, at + i + 4), 1);
  };
  const __m512i low = eight(0), high = eight(8);
  const __m512i even = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
  return {(I16)_mm512_permutex2var_epi32(low, even, high),
          (I16)_mm512_permutex2var_epi32(low, _mm512_add_epi32(even, _mm512_set1_epi32(1)), high)};
}
template <>
inline F16 FromTable<F16>(const float (&table)[16], I16 index) {
  return _mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(table));
}
template <>
inline I16 FromTable<F16>(const std::int32_t (&table)[16], I16 index) {
  return (I16)_mm512_permutexvar_epi32((__m512i)index, _mm512_loadu_si512(table));
}
inline I16 GatherByte(const std::uint8_t* from, I16 index) {
  return (I16)_mm512_i32gather_epi32((__m512i)index, from, 1) & SplatInt<F16>(0xff);
}
// Returns a mask in which all lanes of a half are set if a lane of this half is set.
inline Mask16 AnyOfEight(Mask16 mask) {
  const int bits = Bits(mask);
  return {
      static_cast<__mmask16>(((bits & 0xff) != 0 ? 0xff : 0) | ((bits >> 8) != 0 ? 0xff00 : 0))};
}
inline void StoreGroups(Mask16 mask, float* to, const Places<F16>& at, F16 value) {
  _mm256_mask_storeu_ps(to + at.of[0], static_cast<__mmask8>(mask.bits),
                        _mm512_castps512_ps256(value));
  _mm256_mask_storeu_ps(to + at.of[1], static_cast<__mmask8>(mask.bits >> 8),
                        _mm512_extractf32x8_ps(value, 1));
}
inline void StoreAllGroups(std::uint32_t* to, const Places<F16>& at, I16 value) {
  StoreInt(to + at.of[0], (I8)_mm512_castsi512_si256((__m512i)value));
  StoreInt(to + at.of[1], (I8)_mm512_extracti32x8_epi32((__m512i)value, 1));
}
inline void StoreGroupInts(Mask16 mask, std::uint32_t* to, const Places<F16>& at, I16 value) {
  _mm256_mask_storeu_epi32(to + at.of[0], static_cast<__mmask8>(mask.bits),
                           _mm512_castsi512_si256((__m512i)value));
  _mm256_mask_storeu_epi32(to + at.of[1], static_cast<__mmask8>(mask.bits >> 8),
                           _mm512_extracti32x8_epi32((__m512i)value, 1));
}
inline float MaxOf(F16 a) { return _mm512_reduce_max_ps(a); }
inline float MinOf(F16 a) { return _mm512_reduce_min_ps(a); }
inline F16 PowerOfTwo(I16 n) {
  return (F16)_mm512_slli_epi32(_mm512_add_epi32((__m512i)n, _mm512_set1_epi32(127)), 23);
}
template <>
inline F16 ByGroup<F16>(F8 values) {
  const __m512i group = _mm512_set_epi32(1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0);
  return _mm512_permutexvar_ps(group, _mm512_castps256_ps512(values));
}

#pragma GCC pop_options

// Vectors of three components, one for each lane.
template <class F>
struct Three {
  F x, y, z;
};
using F8x3 = Three<F8>;

template <class F>
Three<F> Splat(float x, float y, float z) {
  return {Splat<F>(x), Splat<F>(y), Splat<F>(z)};
}
inline F8x3 Splat(float x, float y, float z) { return Splat<F8>(x, y, z); }
template <class F>
F Clamp01(F a) {
  return Min(Max(a, Splat<F>(0)), Splat<F>(1));
}
// Returns a for k = 0, and b for k = 1.
template <class F>
F Mixed(F a, F b, F k) {
  return Fma(b - a, k, a);
}
template <class F>
Three<F> operator+(const Three<F>& a, const Three<F>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
Three<F> operator-(const Three<F>& a, const Three<F>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
Three<F> operator*(const Three<F>& a, F k) {
  return {a.x * k, a.y * k, a.z * k};
}
template <class F>
Three<F> operator*(const Three<F>& a, const Three<F>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class F>
Three<F> Fma(const Three<F>& a, F k, const Three<F>& c) {
  return {Fma(a.x, k, c.x), Fma(a.y, k, c.y), Fma(a.z, k, c.z)};
}
template <class F>
F Dot(const Three<F>& a, const Three<F>& b) {
  return Fma(a.x, b.x, Fma(a.y, b.y, a.z * b.z));
}
template <class F>
Three<F> Normalized(const Three<F>& a) {
  return a * (Splat<F>(1) / Sqrt(Max(Dot(a, a), Splat<F>(1e-30f))));
}
template <class F>
Three<F> Select(typename Lanes<F>::Mask mask, const Three<F>& a, const Three<F>& b) {
  return {Select(mask, a.x, b.x), Select(mask, a.y, b.y), Select(mask, a.z, b.z)};
}

template <class F>
Three<F> Mixed(const Three<F>& a, const Three<F>& b, F k) {
  return {Mixed(a.x, b.x, k), Mixed(a.y, b.y, k), Mixed(a.z, b.z, k)};
}

}  // namespace gsv::rendering::raster
