// Random drift of a sensor's bias: an Ornstein–Uhlenbeck process with mean 0 and variance 1. The
// value at any instant can be computed directly, without the values at earlier instants.
//
// Method       bisection. The time axis is divided into intervals of 64 correlation times. The
//              values at the ends of the intervals count as independent. The interval that contains
//              the instant is halved repeatedly, down to a thousandth of the correlation time. The
//              value at each midpoint has a normal distribution, because the process is Markov and
//              Gaussian. The mean and the variance of this distribution follow from the values at
//              both ends. Each drawn value has its own random number, keyed by its position on the
//              time axis.
// Source       Rasmussen and Williams, "Gaussian Processes for Machine Learning", appendix B.2, for
//              the distribution of a value between two known values.
// Determinism  the result depends only on the arguments.
#pragma once

#include <cstdint>

#include "gsv/base/sim_time.h"

namespace gsv::sensing {

// `correlation_time` in seconds, > 0: the time in which the correlation falls to 1/e. `stream`
// identifies the process.
double DriftAt(base::SimTime time, double correlation_time, std::uint64_t seed,
               std::uint64_t stream);

}  // namespace gsv::sensing
