// The hardware interfaces of a robot's joints, from <ros2_control>.
//
// Source  ros2_control, "Hardware components": joints with command and state interfaces.
#pragma once

#include <string>
#include <vector>

namespace gsv::model {

// The command and state interfaces of one joint.
struct JointInterfaces {
  std::string joint;                        // the name of a Joint
  std::vector<std::string> command, state;  // "position", "velocity", "effort", …
};

// One <ros2_control> element: a hardware component and its joints.
struct ControlSystem {
  std::string name;
  std::string type;      // "system", "actuator" or "sensor"
  std::string hardware;  // the class of the hardware plugin
  std::vector<JointInterfaces> joints;
};

}  // namespace gsv::model
