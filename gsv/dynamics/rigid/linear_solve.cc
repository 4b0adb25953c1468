#include "gsv/dynamics/rigid/linear_solve.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/check.h"
#include "gsv/base/each_processor.h"
#include "gsv/dynamics/rigid/four_doubles.h"

namespace gsv::dynamics {
namespace {

constexpr double kSingular = 1e-13;

double LargestOf(std::span<const double> row) {
  double largest = 0;
  for (const double value : row) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

GSV_FOR_EACH_PROCESSOR
bool SolveLinear(std::span<double> a, std::span<double> b) {
  const std::size_t n = b.size();
  GSV_CHECK(a.size() == n * n);
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row) {
      if (std::abs(a[row * n + column]) > std::abs(a[pivot * n + column])) pivot = row;
    }
    const double largest = LargestOf(a.subspan(pivot * n, n));
    if (!(std::abs(a[pivot * n + column]) > kSingular * largest)) return false;
    if (pivot != column) {
      std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(pivot * n),
                       a.begin() + static_cast<std::ptrdiff_t>(pivot * n + n),
                       a.begin() + static_cast<std::ptrdiff_t>(column * n));
      std::swap(b[pivot], b[column]);
    }
    const double inverse = 1 / a[column * n + column];
    for (std::size_t row = column + 1; row < n; ++row) {
      const double factor = a[row * n + column] * inverse;
      if (factor == 0) continue;
      // Rounds the first column down to a multiple of four, so that four values are computed at
      // once. This changes values left of the diagonal too. Only LargestOf() reads them later.
      double* const changed = a.data() + row * n;
      const double* const taken = a.data() + column * n;
      std::size_t k = (column + 1) / kFour * kFour;
      for (; k + kFour <= n; k += kFour) FourAt(changed + k) -= FourAt(taken + k) * factor;
      for (; k < n; ++k) changed[k] -= factor * taken[k];
      b[row] -= factor * b[column];
    }
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t k = row + 1; k < n; ++k) b[row] -= a[row * n + k] * b[k];
    b[row] /= a[row * n + row];
  }
  return true;
}

}  // namespace gsv::dynamics
