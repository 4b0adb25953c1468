// The wall clock, which only this file of the core reads. It schedules real time, limits waits and
// is shown to users. No simulated value depends on it.
#pragma once

#include <chrono>

namespace gsv::simulation {

using WallTime = std::chrono::steady_clock::time_point;
using WallDuration = std::chrono::steady_clock::duration;

inline WallTime WallNow() { return std::chrono::steady_clock::now(); }

}  // namespace gsv::simulation
