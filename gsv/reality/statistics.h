// Statistics for comparing real and simulated devices.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gsv::reality {

struct Summary {
  std::size_t count = 0;
  double mean = 0, deviation = 0;  // sample standard deviation: divided by count - 1
};
Summary Summarize(std::span<const double> values);

// Returns a quantile: the value that the fraction `part` (0 to 1) of the values do not exceed.
// Returns 0 if there are no values.
double Quantile(std::vector<double> values, double part);

// Returns 1.4826 times the median distance from the median. For normally distributed values, this
// is the standard deviation. A few outliers change the result little.
double RobustDeviation(std::vector<double> values);

// Returns half the width of the 95 % interval of an estimate, by the jackknife (Efron 1982). Each
// element of `without` is the estimate without one of several equal parts of the data. Returns 0
// for fewer than two elements.
double JackknifeInterval(const std::vector<double>& without);

// Returns the largest difference of the two distribution functions, in [0, 1]; 1 if one sample is
// empty.
double KolmogorovSmirnov(std::vector<double> first, std::vector<double> second);

// Returns the autocorrelation of values that are `lag` apart, in [-1, 1]; 0 if they do not vary.
double Autocorrelation(std::span<const double> values, std::size_t lag);

}  // namespace gsv::reality
