// Reads the resource usage of this process from /proc (proc(5)).
#pragma once

#include <cstdint>

namespace gsv::gateway::metrics {

// The resource usage of this process.
struct ProcessUsage {
  std::uint64_t resident_bytes = 0;
  std::uint64_t allocated_bytes = 0;  // memory allocated by malloc, without its cached memory
  std::uint64_t threads = 0;          // number of threads
  std::uint64_t descriptors = 0;      // number of open file descriptors
  std::uint64_t max_descriptors = 0;  // limit of open file descriptors
  double processor_seconds = 0;       // processor time of all threads
  double start_time = 0;              // start of the process, s since 1970
  double uptime = 0;                  // time since the start of the process, s
};

// Values that cannot be read are zero. Takes about 0.1 ms, and longer with many open file
// descriptors.
ProcessUsage ReadProcessUsage();

}  // namespace gsv::gateway::metrics
