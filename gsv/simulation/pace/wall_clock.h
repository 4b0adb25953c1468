// The wall clock: the only file of the core that reads it. It paces real time, bounds waits and is
// shown to people; nothing that is simulated depends on it.
#pragma once

#include <chrono>

namespace gsv::simulation {

using WallTime = std::chrono::steady_clock::time_point;
using WallDuration = std::chrono::steady_clock::duration;

inline WallTime WallNow() { return std::chrono::steady_clock::now(); }

}  // namespace gsv::simulation
