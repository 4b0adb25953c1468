// Threads  any.
#pragma once

#include <string>

namespace gsv::base {

// The host name of this machine, which other machines may be unable to resolve; "localhost" if it
// has none.
std::string HostName();

}  // namespace gsv::base
