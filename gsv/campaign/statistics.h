// What can be said of numbers that were measured a few times.
#pragma once

#include <cstddef>
#include <vector>

namespace gsv::campaign {

struct Interval {
  double middle = 0, low = 0, high = 0;
};

// The share of passed runs with its 95 % interval: E. B. Wilson, 1927. No runs: from 0 to 1.
Interval PassRate(std::size_t passed, std::size_t runs);

// The mean with its 95 % interval by Student's t. One number, or none: an interval of no width.
Interval Mean(const std::vector<double>& numbers);

}  // namespace gsv::campaign
