// The sensor type "contact" (also "bumper"): where the robot touches something.
//
// Frame       sensor frame; the bumper spans the bearings within half of field_of_view of its x
//             axis.
// Parameters  field_of_view (rad, 2 pi: all around), ground (false: what it stands on is left out,
//             that is contacts whose normal points down within 45 degrees), collision (the names
//             of the collisions that feel, one a line; default: all of the robot; see
//             gsv/model/collision_names.h. A name that no collision has feels nothing).
// Readings    for each contact seven values {point x, y, z (m), normal x, y, z, from the robot to
//             what it touches, depth (m)}, and the label of what it touches; nothing where nothing
//             touches. As a message: gsv_msgs/Bumper.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType BumperType();

}  // namespace gsv::sensing
