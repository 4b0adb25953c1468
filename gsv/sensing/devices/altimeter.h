// The sensor type "altimeter": height above a reference, and how fast it changes.
//
// Frame       the world's z.
// Parameters  vertical_reference (m, in the world; where the sensor starts),
//             vertical_position.noise (m) and vertical_velocity.noise (m/s), see noise.h.
// Readings    values {position (m above the reference), velocity (m/s), reference (m)}. As a
//             message: ros_gz_interfaces/Altimeter.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType AltimeterType();

}  // namespace gsv::sensing
