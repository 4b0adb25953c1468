// `gsv doctor`: reports what is missing on this machine, and the speed of rendering.
#pragma once

#include <string>

namespace gsv::app {

// Prints one line per check and returns the exit code. For `broker` see CheckBroker().
int Doctor(const std::string& broker);

}  // namespace gsv::app
