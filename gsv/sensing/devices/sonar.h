// The sensor type "sonar": the distance to the nearest surface that returns an echo.
//
// Frame       sensor frame: the beam is along x. The robot's own body gives no echo.
// Beam        "ray" casts one ray to the maximum range. If there is no echo, the reading is the
//             maximum. If the echo is nearer than the minimum range (the transducer still rings),
//             the reading is also the maximum. "cone" models a transducer, see sound_cone.h, within
//             the same limits.
// Reading     readings::Sonar.
// Parameters  (with their default values)
//   beam ("ray")            see above; a cone also has the parameters of sound_cone.h
//   min (0 m), max (5 m)    limits of the range
//   field_of_view (0.26 rad)   width of the cone, for the message only. SDFormat's `radius`, the
//                           radius of the cone at `max`, may be given instead.
//   noise (m)               see noise.h; noise changes echoes, and a dropout removes an echo
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType SonarType();

}  // namespace gsv::sensing
