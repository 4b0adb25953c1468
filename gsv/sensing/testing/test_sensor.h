// For tests: the built-in sensor types, and a description for any type.
#pragma once

#include <string>
#include <utility>

#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/registry.h"

namespace gsv::sensing::testing {

inline const SensorRegistry& BuiltInSensors() {
  static const SensorRegistry registry = [] {
    SensorRegistry made;
    AddBuiltInSensors(made);
    return made;
  }();
  return registry;
}

// Describes the sensor "front", 0.2 m ahead of its link's origin and 0.3 m above it.
inline model::SensorDescription DescriptionOf(const std::string& type,
                                              model::Parameters parameters = {}) {
  model::SensorDescription description;
  description.name = "front";
  description.type = type;
  description.link_from_sensor = geometry::PlanarPose(0.2, 0, 0.3, 0);
  description.parameters = std::move(parameters);
  return description;
}

}  // namespace gsv::sensing::testing
