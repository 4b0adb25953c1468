// Bounds on what a broker's process may take from the machine.
#pragma once

#include <cstddef>

#include "gsv/base/error.h"

namespace gsv::broker {

struct ProcessLimits {
  // A message of 64 KiB can make omniORB take some 130 MiB for a moment; an attacker with many
  // connections gets bad_alloc, not the machine.
  std::size_t address_space_bytes = std::size_t{2} << 30;
  int malloc_arenas = 2;
};

// For the whole process, from now on. Call it before threads start.
[[nodiscard]] base::Status ApplyProcessLimits(const ProcessLimits& limits);

}  // namespace gsv::broker
