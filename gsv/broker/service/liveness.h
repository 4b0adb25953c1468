// Checks whether the service behind a reference still exists.
#pragma once

#include <chrono>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/broker/trader/liveness_monitor.h"

namespace gsv::broker {

// Calls _non_existent. kGone: the service reports so, or the operating system at its address refuses
// the connection. kSilent: no answer in time, also if the network is cut. kAlive: any other answer.
// A service that this ORB cannot address counts as alive.
Liveness CheckLiveness(CORBA::ORB_ptr orb, const std::string& reference,
                       std::chrono::milliseconds timeout);

}  // namespace gsv::broker
