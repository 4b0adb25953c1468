// Checks whether this machine is ready for simulations: limits, ports, libraries, disk space, a
// broker.
//
// Each check prints one line, with a remedy if something is missing.
#pragma once

#include <string>

namespace gsv::app {

// False if a part is missing that simulations need.
bool CheckMachine();
// `broker` empty: that of this user's newest instance, if there is one. False if a broker is named
// that does not answer.
bool CheckBroker(const std::string& broker);

}  // namespace gsv::app
