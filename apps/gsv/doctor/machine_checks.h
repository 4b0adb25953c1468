// Checks whether this machine is ready for simulations: limits, ports, libraries, disk space, a
// broker.
//
// Each check prints one line, with a remedy if something is missing.
#pragma once

#include <string>

namespace gsv::app {

// Returns false if a part that simulations need is missing.
bool CheckMachine();
// Checks the broker with the reference `broker`. If `broker` is empty, checks the broker of this
// user's newest instance, if there is one. Returns false if the broker `broker` does not respond.
bool CheckBroker(const std::string& broker);

}  // namespace gsv::app
