// The types of sensors and actuators that come with GSV, cameras apart: those need a renderer, see
// gsv/rendering/cameras.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// `registry` must have none of their names yet.
void AddBuiltInSensors(SensorRegistry& registry);

}  // namespace gsv::sensing
