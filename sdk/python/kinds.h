// Binds classes of sensors and the structs of their readings.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "sdk/behaviour/sensors.h"
#include "sdk/python/values.h"

namespace gsv::python {

// Makes the Python object of a sensor.
using SensorMaker = py::object (*)(std::unique_ptr<SensorPort>);
// The functions that make sensor objects, by sensor type.
std::map<std::string, SensorMaker>& SensorMakers();

template <typename Kind>
py::object MakeSensorOf(std::unique_ptr<SensorPort> port) {
  return py::cast(std::make_unique<Kind>(std::move(port)));
}

// Binds a class of sensors. Its attribute TYPE is the sensor type.
template <typename Kind>
py::class_<Kind> BindKind(py::module_& module, const char* name, py::class_<Sensor>& sensor,
                          const char* description) {
  py::class_<Kind> kind(module, name, sensor, description);
  kind.attr("TYPE") = Kind::kType;
  SensorMakers()[Kind::kType] = MakeSensorOf<Kind>;
  return kind;
}

// Binds a struct of gsv/readings/catalogue.h, with fields as attributes and units as docstrings.
template <typename Struct>
py::class_<Struct> BindReading(py::handle scope, const char* name, const char* description = "") {
  py::class_<Struct> bound(scope, name, description);
  readings::ForEachField<Struct>(
      [&](const auto& field) { bound.def_readonly(field.name, field.member, field.unit); });
  return bound;
}

// Keeps the deprecated name `old` for the object `name`.
inline void Deprecate(py::handle scope, const char* old, const char* name) {
  scope.attr(old) = scope.attr(name);
}

void BindActuators(py::module_& module, py::class_<Sensor>& sensor);

}  // namespace gsv::python
