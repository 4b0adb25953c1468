// Simulated time: integer nanoseconds since the start of the simulation.
//
// SimTime is never wall-clock time. Code that measures wall-clock time uses
// std::chrono::steady_clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace gsv::base {

using SimTime = std::chrono::nanoseconds;

inline double ToSeconds(SimTime time) { return static_cast<double>(time.count()) * 1e-9; }

// Rounds to the nearest nanosecond. `seconds` must be finite and below 9e9 in magnitude.
inline SimTime FromSeconds(double seconds) {
  return SimTime(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

// Returns the time as nanoseconds for a message. `time` must not be negative.
inline std::uint64_t NanosecondsOf(SimTime time) {
  return static_cast<std::uint64_t>(time.count());
}

}  // namespace gsv::base
