// Memory put by for a broker whose address space is bounded (process_limits.h): it goes to whoever
// finds none left, and from then on what would keep more is refused until as much is free again. So
// a full broker answers queries over new connections too, lets offers be withdrawn, and no thread
// of the ORB's, which does not catch bad_alloc, runs out.
//
// Threads  any; HoldMemoryReserve() before others start.
#pragma once

#include <cstddef>

namespace gsv::broker {

// For the whole process, from now on.
void HoldMemoryReserve(std::size_t bytes);

// Throws CORBA::NO_MEMORY while less is free than was to be put by. For operations that keep what
// they are told. A process that holds no reserve has no bound.
void RequireMemoryReserve();

}  // namespace gsv::broker
