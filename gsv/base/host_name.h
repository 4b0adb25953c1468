// Threads  any.
#pragma once

#include <string>

namespace gsv::base {

// What this machine calls itself, which others need not know it by; "localhost" where it has no
// name.
std::string HostName();

}  // namespace gsv::base
