// A sonar: the distance to the nearest echo.
//
// Frame       sensor frame: the beam runs along x. The robot's own body gives no echo.
// Beam        "ray" is the rule of the original system: one ray to the maximum range; no echo, or
//             one nearer than the minimum range (the transducer still rings), reads as the maximum.
//             "cone" hears what a transducer hears, see sound_cone.h, within the same limits.
// Reading     readings::Sonar.
// Parameters  beam ("ray"); min (0), max (5): range, metres. field_of_view (0.26): the cone's
//             width in radians, for the message only; `radius`, the cone's radius at max as
//             SDFormat has it, gives it too. noise (m), see noise.h: on echoes, which a dropout
//             makes inaudible. Of a cone those of sound_cone.h.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType SonarType();

}  // namespace gsv::sensing
