// A gripper: two jaws that close on what is between them, and hold it.
//
// Frame       x along the jaws, from where they begin; y across, the way that they move.
// Told        1: to open, 0: to close. It is open at first. What stands between the jaws as they
//             close is held, once they are as near to each other as it is wide, until they open: a
//             body that is neither fixed, robot nor avatar, and narrower than the jaws when open.
// Reading     how far it is open (m), 1 if it was told to open or 0. Label: what it holds, or
//             empty.
// Parameters  opening (0.1 m, between the open jaws), reach (0.08 m, the jaws' length), height
//             (0.03 m), closing_time (0.5 s), left_jaw and right_jaw (prismatic joints that show
//             the jaws: zero where they are open, then the way that each has come; of robots that
//             no forces move).
// Message     gsv_msgs/Gripper
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType GripperType();

}  // namespace gsv::sensing
