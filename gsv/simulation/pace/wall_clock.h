// The wall clock. This is the only file of the core that reads it. Its uses are the schedule in
// real time, time limits, and times that users see. No simulated value depends on it.
#pragma once

#include <chrono>

namespace gsv::simulation {

using WallTime = std::chrono::steady_clock::time_point;
using WallDuration = std::chrono::steady_clock::duration;

inline WallTime WallNow() { return std::chrono::steady_clock::now(); }

}  // namespace gsv::simulation
