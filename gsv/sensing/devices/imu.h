// The sensor type "imu": gyroscopes and accelerometers.
//
// Frame       sensor frame. An IMU measures the specific force, which is acceleration minus
//             gravity: +9.8 m/s² along the world's z at rest, and zero in free fall.
// Parameters  (with their default values)
//   angular_velocity.{x,y,z}.noise (rad/s), linear_acceleration.{x,y,z}.noise (m/s²)   see noise.h
//   {angular_velocity,linear_acceleration}.noise_density (0)
//   {angular_velocity,linear_acceleration}.bias_instability (0)
//   {angular_velocity,linear_acceleration}.random_walk (0)
//                           noise as an Allan plot shows it, each value for all three axes. The
//                           units are those of the quantity (rad/s or m/s²): noise_density per
//                           sqrt(Hz), bias_instability as it is, and random_walk per sqrt(s).
//   enable_orientation (true)   whether readings include the orientation
//   orientation_reference_frame   see orientation_reference.h
// Readings    values {angular velocity x, y, z (rad/s), specific force x, y, z (m/s²)}. If enabled,
//             {orientation w, x, y, z} follows, which is world_from_sensor, or
//             reference_from_sensor for another reference frame. As a message: sensor_msgs/Imu.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType ImuType();

}  // namespace gsv::sensing
