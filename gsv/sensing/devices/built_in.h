// The sensor and actuator types of GSV except cameras, which need a renderer
// (gsv/rendering/cameras).
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// `registry` must not have any of their names.
void AddBuiltInSensors(SensorRegistry& registry);

}  // namespace gsv::sensing
