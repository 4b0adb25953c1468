// What all simulations of this process have done since it started, for those who watch it run.
//
// Threads  any; a stepping thread adds without waiting. Nothing that is simulated reads it.
#pragma once

#include <atomic>
#include <cstdint>

namespace gsv::simulation {

struct Totals {
  std::atomic<std::uint64_t> steps{0};
  std::atomic<std::uint64_t> late_steps{0};
};

inline Totals& ProcessTotals() {
  static Totals totals;
  return totals;
}

}  // namespace gsv::simulation
