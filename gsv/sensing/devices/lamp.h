// A lamp or LED. It glows, and may light the objects around it.
//
// Command     brightness in [0, 1] (0: off), then red, green and blue of its colour, each in [0,
//             1].
// Reading     the values of the command.
// Parameters  colour ("1 1 1"), brightness (0; at the start), radius (0.02 m, of the glowing
//             sphere), range (0 m: lights nothing), angle (6.2832 rad: all around, else a cone
//             about its x axis), intensity (1: at full brightness, white at 1 m is fully white).
// Message     gsv_msgs/Lamp
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LampType();

}  // namespace gsv::sensing
