// The sensor type "magnetometer": the earth's magnetic field, from the world file
// (<magnetic_field>).
//
// Frame       sensor frame.
// Parameters  {x,y,z}.noise in tesla, see noise.h.
// Readings    values {x, y, z} in tesla. As a message: sensor_msgs/MagneticField.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType MagnetometerType();

}  // namespace gsv::sensing
