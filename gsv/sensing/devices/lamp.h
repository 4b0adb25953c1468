// A lamp or LED. It glows, and may light the objects around it.
//
// Command     brightness in [0, 1] (0: off), then red, green and blue of its colour, each in [0,
//             1].
// Reading     the values of the command.
// Parameters  (with their default values)
//   colour ("1 1 1")        red, green and blue at the start
//   brightness (0)          brightness at the start
//   radius (0.02 m)         radius of the glowing sphere
//   range (0 m)             distance up to which the lamp lights objects; 0: it lights no objects
//   angle (6.2832 rad)      all around, or the width of a cone about the x axis
//   intensity (1)           with 1, full brightness makes a white surface at 1 m fully white
// Message     gsv_msgs/Lamp
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LampType();

}  // namespace gsv::sensing
