// The limits that apply to each simulation in this process. docs/limits.md lists them.
//
// Threads  set before the first simulation is created; afterwards any thread may read them.
#pragma once

#include <cstddef>

namespace gsv::simulation {

// The maximum numbers of robots and of sensors.
struct Limits {
  std::size_t robots = 100'000;           // number of robots, including avatars
  std::size_t sensors_of_a_robot = 1024;  // sensors of a robot, including those of its model
};

inline Limits& ProcessLimits() {
  static Limits limits;
  return limits;
}

}  // namespace gsv::simulation
