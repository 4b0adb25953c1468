// The CORBA servants of one robot's joints, on top of a simulation::Agent.
//
// Threads  ORB threads. The servants have no state; all state is in the agent.
#pragma once

#include <memory>
#include <string>

#include "gsv/services/hardware_servants.h"
#include "idl/joints.hh"

namespace gsv::services {

// Lists the joints that take commands.
sba::JointTraitsList* ListJoints(const simulation::Agent& agent);

// Activates the joint with that name in the group. Throws sba::Refused if no joint with that name
// takes commands.
sba::JointActuator_ptr ActivateJoint(std::shared_ptr<simulation::Agent> agent,
                                     const std::string& name,
                                     const std::shared_ptr<ServantGroup>& group);

}  // namespace gsv::services
