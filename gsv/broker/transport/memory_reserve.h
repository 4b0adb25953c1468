// A memory reserve for a broker with limited address space (process_limits.h). The reserve is freed
// when an allocation fails. Then operations that would store more data are refused until there is
// enough free memory to fill the reserve again. So a full broker still answers queries, also over
// new connections, and clients can withdraw offers. The ORB's threads, which do not catch
// bad_alloc, do not run out of memory.
//
// Threads  any; call HoldMemoryReserve() before other threads start.
#pragma once

#include <cstddef>

namespace gsv::broker {

// Reserves memory for the whole process.
void HoldMemoryReserve(std::size_t bytes);

// Fills the reserve again if it was freed. Throws CORBA::NO_MEMORY if there is not enough free
// memory. Operations that store their arguments call this function. It does nothing in a process
// without a reserve.
void RequireMemoryReserve();

}  // namespace gsv::broker
