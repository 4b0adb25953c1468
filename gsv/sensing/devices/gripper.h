// A gripper: two fingers that close on a body between them and attach it.
//
// Frame       x along the fingers, from their base; y across, the direction in which they move.
// Command     1: open, 0: close. The gripper is open at first. While the fingers close, they attach
//             a body as soon as they touch it on both sides. The body stays attached until the
//             fingers open. The body must not be static, a robot or an avatar, and must be narrower
//             than the opening.
// Reading     the opening (m), and 1 or 0 as commanded. Label: the name of the attached body, or
//             empty.
// Parameters  (with their default values)
//   opening (0.1 m)         distance between the open fingers
//   reach (0.08 m), height (0.03 m)   length and height of the fingers
//   closing_time (0.5 s)    time in which open fingers close completely
//   left_jaw, right_jaw     names of the prismatic joints of the fingers (default: none). Only for
//                           robots with planar kinematics: the gripper sets the position of each
//                           joint to the distance by which the finger has moved from its open
//                           position.
// Message     gsv_msgs/Gripper
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType GripperType();

}  // namespace gsv::sensing
