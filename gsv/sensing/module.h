// How a library brings sensor types that gsv has never heard of. In one of its files:
//
//   base::Status Add(sensing::SensorRegistry& registry) { return registry.Add(...); }
//   GSV_SENSOR_MODULE(Add)
//
// The library is linked to nothing of GSV: what it uses is found in the gsv that loads it. A type
// that has an IDL interface of its own registers its servant there too
// (services/sensor_servants.h). docs/sensors.md tells how it is built and loaded; examples/infrared
// is one.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// Grows with every change of SensorType, Sensor, Device, Sampling or Reading.
inline constexpr int kSensorInterface = 4;
inline constexpr const char* kSensorModuleSymbol = "gsv_sensor_module";

struct SensorModule {
  int interface_version = kSensorInterface;
  base::Status (*add)(SensorRegistry& registry) = nullptr;
};

}  // namespace gsv::sensing

extern "C" const gsv::sensing::SensorModule* gsv_sensor_module();

#define GSV_SENSOR_MODULE(add)                                                           \
  extern "C" const gsv::sensing::SensorModule* gsv_sensor_module() {                     \
    static const gsv::sensing::SensorModule module{gsv::sensing::kSensorInterface, add}; \
    return &module;                                                                      \
  }
