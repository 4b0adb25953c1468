// The sensor and actuator types of GSV except cameras, which need a renderer
// (gsv/rendering/cameras).
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// Adds the built-in types. `registry` must not contain types with the same names.
void AddBuiltInSensors(SensorRegistry& registry);

}  // namespace gsv::sensing
