// Statistics by which real and simulated devices are compared.
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

// The value below which `part` of them lie, in [0, 1]; 0 of none.
double Quantile(std::vector<double> values, double part);

// 1.4826 times the median distance from the median: the deviation of normal values, and little
// moved by a few wild ones.
double RobustDeviation(std::vector<double> values);

// Half the width of the 95 % interval of an estimate, by the jackknife (Efron 1982): `without` are
// the estimates without each of several equal parts of the data. 0 of less than two.
double JackknifeInterval(const std::vector<double>& without);

// The largest distance between the two distribution functions, in [0, 1]; 1 if one is empty.
double KolmogorovSmirnov(std::vector<double> first, std::vector<double> second);

// The autocorrelation of consecutive values, in [-1, 1]; 0 if they do not vary.
double Autocorrelation(std::span<const double> values, std::size_t lag);

}  // namespace gsv::reality
