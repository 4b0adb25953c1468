// The sensor type "odometry" (also "wheel_odometry"): dead reckoning from the wheels, see
// world/wheel_odometry.h.
//
// Frame       the pose of the base's reference point (halfway between the wheels), relative to its
//             pose at the start.
//             The mounting of the sensor has no effect.
// Parameters  (with their default values)
//   linear.noise (m/s; also for the lateral velocity), angular.noise (rad/s)   see noise.h
//   scale.linear (1), scale.angular (1)   measured distance or angle divided by the true one
//   random.linear_per_metre (0 m), random.angular_per_metre (0 rad)
//   random.angular_per_radian (0 rad)
//                           standard deviations after one metre and one radian. They grow with the
//                           root of the distance; see odometry_drift.h.
// Readings    readings::Odometry; the lateral velocity is the velocity that the drive commands to
//             its wheels. As a message: nav_msgs/Odometry from ROBOT/odom to ROBOT/base_link.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType OdometerType();

}  // namespace gsv::sensing
