// The emulated hardware of one robot as the behaviour's process sees it: sba::Hardware with its
// sensors, base and clocks, over a simulation::Agent.
//
// Threads  ORB threads; all state is the agent's.
#pragma once

#include <memory>

#include "gsv/services/servant_group.h"
#include "gsv/simulation/agent.h"

namespace gsv::services {

// A reference to new hardware for `agent`, one more object of the group.
sba::Hardware_ptr ActivateHardware(std::shared_ptr<simulation::Agent> agent,
                                   std::shared_ptr<ServantGroup> group);

}  // namespace gsv::services
