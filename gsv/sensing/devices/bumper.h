// The sensor type "contact" (also "bumper"): the contacts of the robot.
//
// Frame       sensor frame; the bumper spans the bearings within half of field_of_view of its x
//             axis.
// Parameters  (with their default values)
//   field_of_view (2 pi rad)   2 pi: all around
//   collision (all)         names of the robot's collisions that sense contacts, one per line; see
//                           gsv/model/collision_names.h. An unknown name senses nothing.
//   ground                  whether to report contacts with the ground, whose normals point down
//                           within 45 degrees (default: only if `collision` has names)
// Readings    for each contact point, the label is the name of the other body. There are eleven
//             values:
//   x, y, z (m)             the point
//   x, y, z                 the unit normal, from the robot to the other body
//   depth (m)
//   closing speed (m/s)
//   x, y, z (N)             the mean force on the robot over the last step
// Message     gsv_msgs/Bumper
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType BumperType();

}  // namespace gsv::sensing
