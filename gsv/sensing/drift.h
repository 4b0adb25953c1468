// The Ornstein–Uhlenbeck process of variance 1, for drifting biases. Its value at any instant is
// computed without earlier values.
//
// Method       the process is Markov and Gaussian. So the value in the middle between two known
//              values has a normal distribution with a known mean and variance. Values at a
//              distance of 64 correlation times count as independent. Intervals between them are
//              halved until the instant is reached. Each value is drawn with its own number.
// Source       for the distribution between two values: Rasmussen and Williams, "Gaussian Processes
//              for Machine Learning", appendix B.2.
// Determinism  a function of the arguments.
#pragma once

#include <cstdint>

#include "gsv/base/sim_time.h"

namespace gsv::sensing {

// `correlation_time` in seconds, > 0: the time in which the correlation falls to 1/e. `stream`
// identifies the process.
double DriftAt(base::SimTime time, double correlation_time, std::uint64_t seed,
               std::uint64_t stream);

}  // namespace gsv::sensing
