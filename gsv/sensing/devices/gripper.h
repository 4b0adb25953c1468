// A gripper: two fingers that close on a body between them and attach it.
//
// Frame       x along the fingers, from their base; y across, the direction in which they move.
// Command     1: open, 0: close. It is open at first. While the fingers close, a body between them
//             is attached when the fingers touch it on both sides. It stays attached until they
//             open. The body must not be static, a robot or an avatar, and must be narrower than
//             the opening.
// Reading     the opening (m), and 1 or 0 as commanded. Label: the name of the attached body, or
//             empty.
// Parameters  (with their default values)
//   opening (0.1 m)         distance between the open fingers
//   reach (0.08 m), height (0.03 m)   length and height of the fingers
//   closing_time (0.5 s)    time in which open fingers close completely
//   left_finger, right_finger   prismatic joints that show the fingers, for robots with planar
//                           kinematics only. Their position is the distance that each finger has
//                           moved from the open gripper.
// Message     gsv_msgs/Gripper
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType GripperType();

}  // namespace gsv::sensing
