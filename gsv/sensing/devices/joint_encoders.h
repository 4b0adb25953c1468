// The sensor type "joint_encoders" (also "joint_state"): positions and velocities of joints.
//
// Parameters  (with their default values)
//   joint (all)             name of one joint; default: all revolute, continuous, prismatic and
//                           screw joints. The position of a screw joint is its angle
//   counts_per_turn (0)     positions are rounded down to multiples of 2 pi / counts_per_turn; 0:
//                           positions are exact
//   position.noise (rad or m), velocity.noise (rad/s or m/s)   see noise.h
// Readings    for each joint, in the order of the model, the values {position, velocity}, and its
//             name as label. As a message: sensor_msgs/JointState.
// Errors      Sample(): kNotFound if the robot has no such joint of these kinds.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType JointEncodersType();

}  // namespace gsv::sensing
