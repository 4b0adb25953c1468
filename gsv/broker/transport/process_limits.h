// Bounds on what a broker's process may take from the machine.
#pragma once

#include <cstddef>

#include "gsv/base/error.h"

namespace gsv::broker {

struct ProcessLimits {
  // Whoever wants more gets bad_alloc, not the machine; a sixteenth is held back for whoever must
  // not (memory_reserve.h).
  std::size_t address_space_bytes = std::size_t{2} << 30;
  int malloc_arenas = 2;
  std::size_t descriptors = 8192;  // as far as the system lets the process have them
};

// For the whole process, from now on. Call it before threads start.
[[nodiscard]] base::Status ApplyProcessLimits(const ProcessLimits& limits);

// How many connections clients may keep open, so that descriptors remain for the rest.
std::size_t MaxConnections();

}  // namespace gsv::broker
