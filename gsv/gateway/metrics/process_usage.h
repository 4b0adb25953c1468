// What this process uses of the machine, from /proc (proc(5)).
#pragma once

#include <cstdint>

namespace gsv::gateway::metrics {

struct ProcessUsage {
  std::uint64_t resident_bytes = 0;
  std::uint64_t allocated_bytes = 0;  // that malloc gave out: what it keeps for later is not in it
  std::uint64_t threads = 0;
  std::uint64_t descriptors = 0;
  std::uint64_t max_descriptors = 0;  // that it may open
  double processor_seconds = 0;       // of all its threads
  double start_time = 0;              // s since 1970
  double uptime = 0;                  // s
};

// What cannot be read stays zero. About 0.1 ms, and a little for each descriptor.
ProcessUsage ReadProcessUsage();

}  // namespace gsv::gateway::metrics
