// The sensor type "navsat" (also "gps", "gnss"): satellite navigation (GNSS), in a world with a
// position on the earth (<spherical_coordinates>).
//
// Parameters  see noise.h
//   position_sensing.{horizontal,vertical}.noise (m)
//   velocity_sensing.{horizontal,vertical}.noise (m/s)
// Readings    values {latitude (degrees), longitude (degrees), altitude (m above WGS84's
//             ellipsoid), velocity to the east, to the north, up (m/s)}. As a message:
//             sensor_msgs/NavSatFix.
// Errors      Sample(): kUnavailable in a world without <spherical_coordinates>.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType NavsatType();

}  // namespace gsv::sensing
