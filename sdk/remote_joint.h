// A Joint that is used through an sba::JointActuator reference.
//
// Threads  the behaviour's thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "idl/joints.hh"
#include "sdk/remote_robot.h"

namespace gsv::sdk {

// ListRemoteJoints() and OpenRemoteJoint() pass on exceptions of the hardware. They throw
// sba::Refused if the hardware does not implement sba::JointedHardware.
std::vector<JointTraits> ListRemoteJoints(sba::Hardware_ptr hardware);
// `robot` must outlive the joint.
std::unique_ptr<Joint> OpenRemoteJoint(RemoteRobot& robot, sba::Hardware_ptr hardware,
                                       const std::string& name);

}  // namespace gsv::sdk
