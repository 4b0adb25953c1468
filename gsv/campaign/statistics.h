// Confidence intervals of small samples.
#pragma once

#include <cstddef>
#include <vector>

namespace gsv::campaign {

// An estimate, and the bounds of its confidence interval.
struct Interval {
  double middle = 0, low = 0, high = 0;  // `middle` is the estimate
};

// Returns the fraction of passed runs with its 95 % interval (E. B. Wilson, 1927). Without runs,
// the interval is 0 to 1.
Interval PassRate(std::size_t passed, std::size_t runs);

// Returns the mean with its 95 % interval by Student's t. For fewer than two numbers, the interval
// has width 0.
Interval Mean(const std::vector<double>& numbers);

}  // namespace gsv::campaign
