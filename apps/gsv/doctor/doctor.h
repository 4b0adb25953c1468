// `gsv doctor`: reports what is missing on this machine, and the speed of rendering.
#pragma once

#include <string>

namespace gsv::app {

// Prints one line per check. Returns the exit code. `broker`: see CheckBroker().
int Doctor(const std::string& broker);

}  // namespace gsv::app
