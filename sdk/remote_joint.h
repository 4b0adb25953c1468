// The Joint behind an sba::JointActuator reference.
//
// Threads  the behaviour's thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "idl/joints.hh"
#include "sdk/remote_robot.h"

namespace gsv::sdk {

// Both raise what the hardware does, and sba::Refused when it has no joints to command.
std::vector<JointTraits> ListRemoteJoints(sba::Hardware_ptr hardware);
// `robot` outlives it.
std::unique_ptr<Joint> OpenRemoteJoint(RemoteRobot& robot, sba::Hardware_ptr hardware,
                                       const std::string& name);

}  // namespace gsv::sdk
