// What a machine has to offer to simulations: limits, ports, libraries, room, a broker.
//
// Each check prints one line; where something lacks, with what to do.
#pragma once

#include <string>

namespace gsv::app {

// False where something is missing without which simulations do not run as they should.
bool CheckMachine();
// `broker` empty: that of the newest instance of this user, if there is one. False when one is
// named and does not answer.
bool CheckBroker(const std::string& broker);

}  // namespace gsv::app
