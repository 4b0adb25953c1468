// The data that recording_victim sends to kill_test through a pipe, as raw bytes: one struct for
// each snapshot.
#pragma once

#include <cstdint>
#include <ctime>

namespace gsv::recording {

struct HandOver {
  std::int64_t time_ns = 0;  // simulated time
  std::int64_t wall_ns = 0;  // wall-clock time after the recorder took the snapshot
};

// Returns the time of a clock that is the same for all processes of a machine.
inline std::int64_t WallNow() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

}  // namespace gsv::recording
