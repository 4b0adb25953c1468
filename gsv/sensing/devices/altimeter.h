// The sensor type "altimeter": the height above a reference, and its rate of change.
//
// Frame       the world's z.
// Parameters
//   vertical_reference      height in the world, m (default: the initial height of the sensor)
//   vertical_position.noise (m), vertical_velocity.noise (m/s)   see noise.h
// Readings    values {position (m above the reference), velocity (m/s), reference (m)}. As a
//             message: ros_gz_interfaces/Altimeter.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType AltimeterType();

}  // namespace gsv::sensing
