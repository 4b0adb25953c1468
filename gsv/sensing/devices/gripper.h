// A gripper: two fingers that close on a body between them and attach it.
//
// Frame       x along the fingers, from their base; y across, the direction in which they move.
// Command     1: open, 0: close. It is open at first. While the fingers close, a body between them
//             is attached when they are as close as the body is wide. It stays attached until they
//             open. The body must not be static, a robot or an avatar, and must be narrower than
//             the opening.
// Reading     the opening (m), and 1 or 0 as commanded. Label: the name of the attached body, or
//             empty.
// Parameters  opening (0.1 m, between the open fingers), reach (0.08 m, length of the fingers),
//             height (0.03 m), closing_time (0.5 s), left_finger and right_finger (prismatic joints
//             that show the fingers: zero if open, else the distance that each has moved; for
//             robots with planar kinematics only).
// Message     gsv_msgs/Gripper
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType GripperType();

}  // namespace gsv::sensing
