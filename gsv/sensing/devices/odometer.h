// The sensor type "odometry" (also "wheel_odometry"): dead reckoning from the wheels, see
// world/wheel_odometry.h.
//
// Frame       the base's reference point (halfway between the wheels) in the frame of its start.
//             The mounting of the sensor has no effect.
// Parameters  linear.noise (m/s; also for the lateral velocity) and angular.noise (rad/s), see
//             noise.h. Errors that accumulate: scale.linear, scale.angular (1: the factor between
//             odometry and truth for each metre and radian); random.linear_per_metre (m),
//             random.angular_per_metre and random.angular_per_radian (rad): deviations after one
//             metre and one radian, which grow with the root of the distance. See odometry_drift.h.
// Readings    readings::Odometry; the lateral velocity is the one that the drive commands to its
//             wheels. As a message: nav_msgs/Odometry from ROBOT/odom to ROBOT/base_link.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType OdometerType();

}  // namespace gsv::sensing
