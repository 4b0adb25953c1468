// The sensor type "battery": the charge after the time and distance of the robot.
//
// Model       the charge falls by idle_current at all times and by drive_charge for each metre; the
//             voltage lies between empty and full in proportion to the charge, less the voltage
//             drop at the resistance. An empty battery stops nothing.
// Parameters  capacity (Ah, 5), initial_charge (fraction, 1), voltage_full (V, 12.6), voltage_empty
//             (V, 10.5), resistance (ohm, 0.1), idle_current (A, 0.5), drive_charge (C/m, 4),
//             voltage.noise (V) and current.noise (A), see noise.h.
// Readings    values {voltage (V), current (A, drawn), charge (Ah), capacity (Ah), fraction}. As a
//             message: sensor_msgs/BatteryState, where a current that is drawn is negative.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType BatteryType();

}  // namespace gsv::sensing
