// `gsv doctor`: what this machine lacks, and how fast it draws.
#pragma once

#include <string>

namespace gsv::app {

// Prints a line for each thing it looks at; gives the exit code. `broker`: see CheckBroker().
int Doctor(const std::string& broker);

}  // namespace gsv::app
