// Products of arrays whose lengths are multiples of four, four values at a time. The sums have the
// same order, and so the same bits, on every processor.
#pragma once

namespace gsv::dynamics {

inline constexpr int kFour = 4;

// The next multiple of four.
constexpr int RoundUpToFour(int count) { return (count + kFour - 1) / kFour * kFour; }

// Four values, which the processor computes together.
typedef double FourDoubles __attribute__((vector_size(32), aligned(8), may_alias));

// Returns the four values that begin at `values`.
inline const FourDoubles& FourAt(const double* values) {
  return *reinterpret_cast<const FourDoubles*>(values);
}
inline FourDoubles& FourAt(double* values) { return *reinterpret_cast<FourDoubles*>(values); }

// Returns the sum of the four values.
__attribute__((always_inline)) inline double SumOf(const FourDoubles& four) {
  return (four[0] + four[2]) + (four[1] + four[3]);
}

// The scalar product of `a` and `b` from `begin` to `end`, both multiples of four.
__attribute__((always_inline)) inline double Product(const double* a, const double* b, int begin,
                                                     int end) {
  FourDoubles sum{};
  for (int i = begin; i < end; i += kFour) sum += FourAt(a + i) * FourAt(b + i);
  return SumOf(sum);
}

// Adds `factor` times `added` to `changed`.
__attribute__((always_inline)) inline void AddTimes(double factor, const double* added, int count,
                                                    double* changed) {
  for (int i = 0; i < count; i += kFour) FourAt(changed + i) += FourAt(added + i) * factor;
}

// Transposes a matrix of four by four values.
__attribute__((always_inline)) inline void Transpose(FourDoubles (&rows)[kFour]) {
  const FourDoubles even_low = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const FourDoubles odd_low = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const FourDoubles even_high = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const FourDoubles odd_high = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(even_low, even_high, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(odd_low, odd_high, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(even_low, even_high, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(odd_low, odd_high, 2, 3, 6, 7);
}

}  // namespace gsv::dynamics
