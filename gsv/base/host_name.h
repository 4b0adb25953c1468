// Threads  any.
#pragma once

#include <string>

namespace gsv::base {

// The name that this machine has for itself, which other machines need not know; "localhost" if it
// has none.
std::string HostName();

}  // namespace gsv::base
