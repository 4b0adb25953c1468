// Whether the service behind a reference still exists.
#pragma once

#include <chrono>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/broker/trader/liveness_monitor.h"

namespace gsv::broker {

// Asks it (_non_existent). kGone only when the service says so, or when the operating system at
// its address does: a network that is cut is silence. A service that answers anything else is
// alive, and so is one that this ORB cannot address.
Liveness CheckLiveness(CORBA::ORB_ptr orb, const std::string& reference,
                       std::chrono::milliseconds timeout);

}  // namespace gsv::broker
