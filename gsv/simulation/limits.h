// What one simulation holds at most, in this process; docs/limits.md lists them.
//
// Threads  set before the first simulation is created, read by any.
#pragma once

#include <cstddef>

namespace gsv::simulation {

struct Limits {
  std::size_t robots = 100'000;           // avatars among them
  std::size_t sensors_of_a_robot = 1024;  // those of its model among them
};

inline Limits& ProcessLimits() {
  static Limits limits;
  return limits;
}

}  // namespace gsv::simulation
