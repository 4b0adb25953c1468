// The sensor type "contact" (also "bumper"): the contacts of the robot.
//
// Frame       sensor frame. The bumper senses a contact point if the angle between its x axis and
//             the point, in its xy plane, is at most half of field_of_view.
// Parameters  (with their default values)
//   field_of_view (2 pi rad)   the angle in which contacts are sensed; 2 pi: all around
//   collision (all)         names of the robot's collisions that sense contacts, one per line; see
//                           gsv/model/collision_names.h. Unknown names are ignored. If all names
//                           are unknown, no contact is sensed.
//   ground                  whether to report contacts with what is below the robot: a body that
//                           supports it, and contacts whose normal is within 45 degrees of
//                           downwards (default: only if `collision` has names)
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
