// The sensor type "odometry" (also "wheel_odometry"): dead reckoning from the wheels, see
// world/wheel_odometry.h.
//
// Frame       the base's reference point (halfway between the wheels) in the frame of its start;
//             where the sensor is mounted does not matter.
// Parameters  linear.noise (m/s) and angular.noise (rad/s) of the velocities, see noise.h.
// Readings    values {x, y (m), yaw (rad), linear (m/s), angular (rad/s)}. As a message:
//             nav_msgs/Odometry from ROBOT/odom to ROBOT/base_link.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType OdometerType();

}  // namespace gsv::sensing
