// The joints of one robot as the behaviour's process sees them, over a simulation::Agent.
//
// Threads  ORB threads; all state is the agent's.
#pragma once

#include <memory>
#include <string>

#include "gsv/services/hardware_servants.h"
#include "idl/joints.hh"

namespace gsv::services {

// Those that take commands.
sba::JointTraitsList* ListJoints(const simulation::Agent& agent);

// A reference to the joint of that name, one more object of the group. Raises sba::Refused when
// there is none that takes commands.
sba::JointActuator_ptr ActivateJoint(std::shared_ptr<simulation::Agent> agent,
                                     const std::string& name,
                                     const std::shared_ptr<ServantGroup>& group);

}  // namespace gsv::services
