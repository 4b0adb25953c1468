// Statistics for comparing real and simulated devices.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gsv::reality {

struct Summary {
  std::size_t count = 0;
  double mean = 0, deviation = 0;  // for a sample: divided by count - 1
};
Summary Summarize(std::span<const double> values);

// Returns the quantile: the value below which the fraction `part` (in [0, 1]) of the values lies. 0
// if there are no values.
double Quantile(std::vector<double> values, double part);

// Returns 1.4826 times the median distance from the median. For normal values, this is the standard
// deviation. A few outliers change it little.
double RobustDeviation(std::vector<double> values);

// Returns half the width of the 95 % interval of an estimate, by the jackknife (Efron 1982).
// `without` are the estimates without each of several equal parts of the data. 0 for less than two.
double JackknifeInterval(const std::vector<double>& without);

// Returns the largest distance of both distribution functions, in [0, 1]; 1 if one is empty.
double KolmogorovSmirnov(std::vector<double> first, std::vector<double> second);

// Returns the autocorrelation of consecutive values, in [-1, 1]; 0 if they do not vary.
double Autocorrelation(std::span<const double> values, std::size_t lag);

}  // namespace gsv::reality
