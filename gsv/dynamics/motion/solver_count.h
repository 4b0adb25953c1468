// A count for benches of how hard the solvers of rigid-body dynamics work.
#pragma once

#include <cstdint>

namespace gsv::dynamics {

// The number of iterations of all islands, engines and threads of this process so far.
std::uint64_t SolverIterations();
// Adds to it. Any thread may call it.
void CountSolverIterations(int iterations);

}  // namespace gsv::dynamics
