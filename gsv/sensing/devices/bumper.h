// The sensor type "contact" (also "bumper"): the contacts of the robot.
//
// Frame       sensor frame; the bumper spans the bearings within half of field_of_view of its x
//             axis.
// Parameters  field_of_view (rad, 2 pi: all around). collision: the names of the collisions that
//             sense contacts, one per line (default: all of the robot); see
//             gsv/model/collision_names.h. An unknown name senses nothing. ground: whether to
//             report the ground, that is points whose normal points down within 45 degrees
//             (default: only if `collision` has names).
// Readings    for each point of each contact eleven values {point x, y, z (m), normal x, y, z from
//             the robot to the other body, depth (m), closing speed (m/s), mean force on the robot
//             over the last step x, y, z (N)}, with the name of the other body as label. As a
//             message: gsv_msgs/Bumper.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType BumperType();

}  // namespace gsv::sensing
