// Checks whether the service behind a reference still exists.
#pragma once

#include <chrono>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/broker/trader/liveness_monitor.h"

namespace gsv::broker {

// Calls _non_existent and returns:
// kGone    if the service reports that it does not exist, or if the operating system at its address
//          refuses the connection;
// kSilent  if there is no answer in time, for example because the network is interrupted;
// kAlive   for any other answer, and for a service that this ORB cannot address.
Liveness CheckLiveness(CORBA::ORB_ptr orb, const std::string& reference,
                       std::chrono::milliseconds timeout);

}  // namespace gsv::broker
