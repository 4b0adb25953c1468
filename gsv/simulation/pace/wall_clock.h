// The wall clock. This is the only file of the core that reads it. Its uses are the schedule in
// real time, time limits, and times that users see. No simulated value depends on it.
#pragma once

#include <time.h>

#include <chrono>

namespace gsv::simulation {

using WallTime = std::chrono::steady_clock::time_point;
using WallDuration = std::chrono::steady_clock::duration;

inline WallTime WallNow() { return std::chrono::steady_clock::now(); }

// Returns the time of the last tick of the system, which is a few milliseconds old. This takes a
// fraction of the time of WallNow().
inline WallTime CoarseWallNow() {
  timespec time{};
  (void)clock_gettime(CLOCK_MONOTONIC_COARSE, &time);
  return WallTime(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

}  // namespace gsv::simulation
