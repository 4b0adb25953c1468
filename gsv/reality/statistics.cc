#include "gsv/reality/statistics.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/sorting.h"

namespace gsv::reality {

Summary Summarize(std::span<const double> values) {
  Summary summary;
  summary.count = values.size();
  if (values.empty()) return summary;
  for (const double value : values) summary.mean += value;
  summary.mean /= static_cast<double>(values.size());
  if (values.size() < 2) return summary;
  double squares = 0;
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  summary.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return summary;
}

double Quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(
      std::clamp(part, 0.0, 1.0) * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

double RobustDeviation(std::vector<double> values) {
  const double median = Quantile(values, 0.5);
  for (double& value : values) value = std::abs(value - median);
  return 1.4826 * Quantile(std::move(values), 0.5);
}

double JackknifeInterval(const std::vector<double>& without) {
  constexpr double k95 = 1.96;
  const Summary summary = Summarize(without);
  const auto count = static_cast<double>(without.size());
  if (count < 2) return 0;
  return k95 * summary.deviation * (count - 1) / std::sqrt(count);
}

double KolmogorovSmirnov(std::vector<double> first, std::vector<double> second) {
  if (first.empty() || second.empty()) return 1;
  base::Sort(first);
  base::Sort(second);
  double largest = 0;
  std::size_t a = 0, b = 0;
  while (a < first.size() && b < second.size()) {
    const double value = std::min(first[a], second[b]);
    while (a < first.size() && first[a] <= value) ++a;
    while (b < second.size() && second[b] <= value) ++b;
    largest =
        std::max(largest, std::abs(static_cast<double>(a) / static_cast<double>(first.size()) -
                                   static_cast<double>(b) / static_cast<double>(second.size())));
  }
  return largest;
}

double Autocorrelation(std::span<const double> values, std::size_t lag) {
  const Summary summary = Summarize(values);
  if (values.size() <= lag || summary.deviation == 0) return 0;
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = values[i] - summary.mean;
    squares += off * off;
    if (i >= lag) products += off * (values[i - lag] - summary.mean);
  }
  return products / squares;
}

}  // namespace gsv::reality
