// Threads  any.
#pragma once

#include <string>

namespace gsv::base {

// Returns the host name of this machine, or "localhost" if it has none. Other machines may be
// unable to resolve the name.
std::string HostName();

}  // namespace gsv::base
