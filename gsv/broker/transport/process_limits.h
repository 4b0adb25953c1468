// Limits on the resources of a broker's process.
#pragma once

#include <cstddef>

#include "gsv/base/error.h"

namespace gsv::broker {

struct ProcessLimits {
  // Allocations beyond this limit fail with bad_alloc. A sixteenth of this limit is a reserve for
  // threads that do not catch bad_alloc (memory_reserve.h).
  std::size_t address_space_bytes = std::size_t{2} << 30;
  int malloc_arenas = 2;           // maximum number of malloc's arenas
  std::size_t descriptors = 8192;  // the process gets fewer if the system allows fewer
};

// Limits the whole process. Call it before threads start.
[[nodiscard]] base::Status ApplyProcessLimits(const ProcessLimits& limits);

// The number of connections that clients may keep open. The limit leaves some file descriptors for
// other uses.
std::size_t MaxConnections();

}  // namespace gsv::broker
