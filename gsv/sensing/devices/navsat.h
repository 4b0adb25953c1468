// The sensor type "navsat" (also "gps", "gnss"): satellite navigation, in a world whose file says
// where on the earth it lies (<spherical_coordinates>).
//
// Parameters  position_sensing.{horizontal,vertical}.noise (m) and
//             velocity_sensing.{horizontal,vertical}.noise (m/s), see noise.h.
// Readings    values {latitude (degrees), longitude (degrees), altitude (m above WGS84's
//             ellipsoid), velocity to the east, to the north, up (m/s)}. As a message:
//             sensor_msgs/NavSatFix.
// Errors      Sample(): kUnavailable in a world that does not say where it lies.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType NavsatType();

}  // namespace gsv::sensing
