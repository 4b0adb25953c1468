// A positioning system: the pose of the sensor in the world.
//
// Reading     values = {x, y, z, roll, pitch, yaw} of the sensor's frame in the world; metres,
//             radians (roll and yaw in (-pi, pi], pitch in [-pi/2, pi/2]).
// Parameters  noise.position.stddev (0): Gaussian, metres, on x, y and z each.
//             noise.orientation.stddev (0): Gaussian, radians, on yaw.
// Message     geometry_msgs/PoseStamped in the frame "world".
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType PositioningType();

}  // namespace gsv::sensing
