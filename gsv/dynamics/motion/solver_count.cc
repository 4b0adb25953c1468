#include "gsv/dynamics/motion/solver_count.h"

#include <atomic>

namespace gsv::dynamics {
namespace {

std::atomic<std::uint64_t> all_solver_iterations{0};

}  // namespace

std::uint64_t SolverIterations() { return all_solver_iterations.load(std::memory_order_relaxed); }

void CountSolverIterations(int iterations) {
  all_solver_iterations.fetch_add(static_cast<std::uint64_t>(iterations),
                                  std::memory_order_relaxed);
}

}  // namespace gsv::dynamics
