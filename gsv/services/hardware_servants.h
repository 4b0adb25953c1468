// The CORBA servants of one robot's hardware: sba::Hardware with sensors, base and clocks, on top
// of a simulation::Agent.
//
// Threads  ORB threads. The servants have no state; all state is in the agent.
#pragma once

#include <memory>

#include "gsv/services/servant_group.h"
#include "gsv/simulation/agent.h"

namespace gsv::services {

// Activates a new hardware servant for `agent` in the group.
sba::Hardware_ptr ActivateHardware(std::shared_ptr<simulation::Agent> agent,
                                   std::shared_ptr<ServantGroup> group);

}  // namespace gsv::services
