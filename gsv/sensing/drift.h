// A quantity that wanders about zero and forgets where it was: the Ornstein–Uhlenbeck process of
// variance 1, whose value at any instant is found without those before it.
//
// Method       the process is Markov and Gaussian, so that between two known values the one in the
//              middle has a normal distribution of known mean and variance. Values 64 correlation
//              times apart are as good as independent; from there it is halved down to the instant,
//              each value being drawn under its own number.
// Source       for the distribution between two values: Rasmussen and Williams, "Gaussian Processes
//              for Machine Learning", appendix B.2.
// Determinism  a function of the arguments.
#pragma once

#include <cstdint>

#include "gsv/base/sim_time.h"

namespace gsv::sensing {

// `correlation_time` in seconds, > 0: values so far apart correlate by 1/e. `stream` names the
// process.
double DriftAt(base::SimTime time, double correlation_time, std::uint64_t seed,
               std::uint64_t stream);

}  // namespace gsv::sensing
