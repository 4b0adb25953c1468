// Bounds for a process that reads what strangers made: memory, time, files, network.
#pragma once

#include <chrono>
#include <cstddef>

#include "gsv/base/error.h"

namespace gsv::app {

struct Confinement {
  std::size_t memory_bytes = std::size_t{4} << 30;  // of address space
  std::chrono::seconds processor_time{60};
};

// With which a confined process ends that wants more memory.
inline constexpr int kWantsMoreMemory = 70;

// For this process, from now on and for good: who wants more memory ends, who takes more time is
// killed; nothing is written to files, no socket is opened, no program is started (seccomp(2), and
// setrlimit(2)). Files can be read. Call it before threads start. Fails where the kernel has no
// such filters.
base::Status Confine(const Confinement& bounds);

}  // namespace gsv::app
