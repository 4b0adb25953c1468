// The sensor type "odometry" (also "wheel_odometry"): dead reckoning from the wheels, see
// world/wheel_odometry.h.
//
// Frame       the base's reference point (halfway between the wheels) in the frame of its start;
//             where the sensor is mounted does not matter.
// Parameters  linear.noise (m/s; of the lateral velocity, too) and angular.noise (rad/s), see
//             noise.h. Of what adds up: scale.linear, scale.angular (1: how much the odometry makes
//             of each metre and radian); random.linear_per_metre (m), random.angular_per_metre and
//             random.angular_per_radian (rad): deviations after one metre and one radian, which grow
//             with the root of the way. See odometry_drift.h.
// Readings    readings::Odometry; the lateral velocity is what the drive tells its wheels to do. As
//             a message: nav_msgs/Odometry from ROBOT/odom to ROBOT/base_link.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType OdometerType();

}  // namespace gsv::sensing
