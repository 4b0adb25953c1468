// Declares the sensor types of a plug-in, which is a shared library. One of its source files
// contains:
//
//   base::Status Add(sensing::SensorRegistry& registry) { return registry.Add(...); }
//   GSV_SENSOR_MODULE(Add)
//
// The library does not link to GSV: the program that loads the library provides the symbols. A type
// with an IDL interface also registers its servant in this function (services/sensor_servants.h).
// docs/sensors.md describes how to build and load the library; examples/infrared is an example.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// The version of the interface. Increase it with every change of SensorType, Sensor, Device,
// Sampling or Reading.
inline constexpr int kSensorInterface = 8;
// Name of the function by which a plug-in returns its SensorModule.
inline constexpr const char* kSensorModuleSymbol = "gsv_sensor_module";

// The symbol that a plug-in exports: its interface version, and the function that adds its types.
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
