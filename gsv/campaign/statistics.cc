#include "gsv/campaign/statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gsv::campaign {
namespace {

constexpr double kNormal975 = 1.959963984540054;

// Returns the 97.5 % quantile of Student's t. For 1 to 30 degrees of freedom, the value is from a
// table. For more degrees of freedom, the value is computed from the first terms of Cornish and
// Fisher's expansion (Abramowitz and Stegun 26.7.5).
double Student975(std::size_t degrees) {
  constexpr double kTable[]{12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060,
                            2.2622,  2.2281, 2.2010, 2.1788, 2.1604, 2.1448, 2.1314, 2.1199,
                            2.1098,  2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687, 2.0639,
                            2.0595,  2.0555, 2.0518, 2.0484, 2.0452, 2.0423};
  if (degrees <= std::size(kTable)) return kTable[degrees - 1];
  const double z = kNormal975, n = static_cast<double>(degrees);
  return z + (z * z * z + z) / (4 * n) +
         (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * n * n);
}

}  // namespace

Interval PassRate(std::size_t passed, std::size_t runs) {
  if (runs == 0) return {0, 0, 1};
  const double n = static_cast<double>(runs), p = static_cast<double>(passed) / n;
  const double z2 = kNormal975 * kNormal975;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kNormal975 / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Interval Mean(const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  const double n = static_cast<double>(numbers.size());
  double sum = 0, squares = 0;
  for (const double number : numbers) sum += number;
  const double mean = sum / n;
  if (numbers.size() == 1) return {mean, mean, mean};
  for (const double number : numbers) squares += (number - mean) * (number - mean);
  const double half = Student975(numbers.size() - 1) * std::sqrt(squares / (n - 1) / n);
  return {mean, mean - half, mean + half};
}

}  // namespace gsv::campaign
