// The sensor type "battery": a battery whose charge follows from the robot's running time and
// distance.
//
// Model       the charge falls by idle_current at all times, and by drive_charge for each metre.
//             The voltage without load is between voltage_empty and voltage_full in proportion to
//             the charge. The voltage drop at the resistance is subtracted. An empty battery has
//             the voltage and the current 0, but the robot can still drive.
// Parameters  (with their default values)
//   capacity (5 Ah)
//   initial_charge (1)      as a fraction of the capacity
//   voltage_full (12.6 V), voltage_empty (10.5 V), resistance (0.1 ohm)
//   idle_current (0.5 A), drive_charge (4 C/m)
//   voltage.noise (V), current.noise (A)   see noise.h
// Readings    values {voltage (V), current (A, drawn), charge (Ah), capacity (Ah), fraction}. As a
//             message: sensor_msgs/BatteryState, where a current that is drawn is negative.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType BatteryType();

}  // namespace gsv::sensing
