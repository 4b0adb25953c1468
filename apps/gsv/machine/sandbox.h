// A sandbox for a process that reads untrusted input: limits on memory, time, files and network.
#pragma once

#include <chrono>
#include <cstddef>

#include "gsv/base/error.h"

namespace gsv::app {

// The limits of a sandbox.
struct Sandbox {
  std::size_t memory_bytes = std::size_t{4} << 30;  // maximum size of the address space
  std::chrono::seconds processor_time{60};          // maximum processor time
};

// The exit code of a sandboxed process that exceeds its memory limit.
inline constexpr int kWantsMoreMemory = 70;

// Puts this process into a sandbox permanently. The process exits with kWantsMoreMemory if it
// exceeds its memory limit, and is killed if it exceeds its time limit. The process can read files,
// but cannot write files, open sockets or start programs (seccomp(2), setrlimit(2)). Call this
// function before threads start. Fails if the kernel does not support seccomp filters.
base::Status EnterSandbox(const Sandbox& bounds);

}  // namespace gsv::app
