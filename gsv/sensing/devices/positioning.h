// The sensor type "positioning": the true pose of the sensor in the world, with optional noise. It
// models an indoor positioning system.
//
// Reading     values {x, y, z (m), roll, pitch, yaw (rad)} of the sensor's frame in the world. Roll
//             and yaw are in (-pi, pi], and the pitch is in [-pi/2, pi/2].
// Parameters  (with their default values)
//   noise.position.stddev (0 m)        Gaussian noise of x, y and z
//   noise.orientation.stddev (0 rad)   Gaussian noise of the yaw
// Message     geometry_msgs/PoseStamped in the frame "map".
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType PositioningType();

}  // namespace gsv::sensing
