// The wall clock. This is the only file of the core that reads it. It serves to schedule real time,
// to limit waits and to show times to users. No simulated value depends on it.
#pragma once

#include <chrono>

namespace gsv::simulation {

using WallTime = std::chrono::steady_clock::time_point;
using WallDuration = std::chrono::steady_clock::duration;

inline WallTime WallNow() { return std::chrono::steady_clock::now(); }

}  // namespace gsv::simulation
