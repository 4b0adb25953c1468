// The sensor type "imu": gyroscopes and accelerometers.
//
// Frame       sensor frame. An IMU measures the specific force, which is acceleration minus
//             gravity: +9.8 m/s² along the world's z at rest, and zero in free fall.
// Parameters  angular_velocity.{x,y,z}.noise (rad/s) and linear_acceleration.{x,y,z}.noise (m/s²),
//             see noise.h; enable_orientation (true); orientation_reference_frame, see
//             orientation_reference.h. Terms of an Allan plot, for all three axes of
//             angular_velocity and linear_acceleration: noise_density (per root hertz),
//             bias_instability, random_walk (per root second), all 0.
// Readings    values {angular velocity x, y, z (rad/s), specific force x, y, z (m/s²)}. If enabled,
//             {orientation w, x, y, z} follows, which is world_from_sensor, or
//             reference_from_sensor for another reference frame. As a message: sensor_msgs/Imu.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType ImuType();

}  // namespace gsv::sensing
