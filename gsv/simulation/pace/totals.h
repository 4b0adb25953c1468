// Numbers of steps of all simulations of this process since it started, for monitoring.
//
// Threads  any; stepping threads add without waiting. No simulated value depends on them.
#pragma once

#include <atomic>
#include <cstdint>

namespace gsv::simulation {

// The number of all steps, and of late steps (see pacer.h).
struct Totals {
  std::atomic<std::uint64_t> steps{0};
  std::atomic<std::uint64_t> late_steps{0};
};

inline Totals& ProcessTotals() {
  static Totals totals;
  return totals;
}

}  // namespace gsv::simulation
