// Counts the iterations of the solvers of rigid-body dynamics, for benchmarks.
#pragma once

#include <cstdint>

namespace gsv::dynamics {

// The number of iterations so far, summed over all islands, engines and threads of this process.
std::uint64_t SolverIterations();
// Adds to the count. Any thread may call it.
void CountSolverIterations(int iterations);

}  // namespace gsv::dynamics
