// A sonar: the distance to the nearest echo.
//
// Frame       sensor frame: the beam is along x. The robot's own body gives no echo.
// Beam        "ray" is the rule of the original system. It casts one ray to the maximum range. If
//             there is no echo, or one nearer than the minimum range (the transducer still rings),
//             the reading is the maximum. "cone" models a transducer, see sound_cone.h, within the
//             same limits.
// Reading     readings::Sonar.
// Parameters  beam ("ray"); min (0), max (5): range in metres. field_of_view (0.26): the cone's
//             width in radians, for the message only; SDFormat's `radius`, the cone's radius at
//             max, may be given instead. noise (m), see noise.h: it applies to echoes, and a
//             dropout removes an echo. A cone also has the parameters of sound_cone.h.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType SonarType();

}  // namespace gsv::sensing
