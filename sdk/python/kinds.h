// How classes of sensors, and the structs that they read, become Python's.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "sdk/behaviour/sensors.h"
#include "sdk/python/values.h"

namespace gsv::python {

using SensorMaker = py::object (*)(std::unique_ptr<SensorPort>);
// The classes by the types that they stand for.
std::map<std::string, SensorMaker>& SensorMakers();

template <typename Kind>
py::object MakeSensorOf(std::unique_ptr<SensorPort> port) {
  return py::cast(std::make_unique<Kind>(std::move(port)));
}

// A class of sensors, whose TYPE is what models call it.
template <typename Kind>
py::class_<Kind> BindKind(py::module_& module, const char* name, py::class_<Sensor>& sensor,
                          const char* description) {
  py::class_<Kind> kind(module, name, sensor, description);
  kind.attr("TYPE") = Kind::kType;
  SensorMakers()[Kind::kType] = MakeSensorOf<Kind>;
  return kind;
}

// A struct of gsv/readings/catalogue.h, with its fields as attributes and their units as
// docstrings.
template <typename Struct>
py::class_<Struct> BindReading(py::handle scope, const char* name, const char* description = "") {
  py::class_<Struct> bound(scope, name, description);
  readings::ForEachField<Struct>(
      [&](const auto& field) { bound.def_readonly(field.name, field.member, field.unit); });
  return bound;
}

// Keeps the name `old` for what is called `name` now.
inline void Deprecate(py::handle scope, const char* old, const char* name) {
  scope.attr(old) = scope.attr(name);
}

void BindActuators(py::module_& module, py::class_<Sensor>& sensor);

}  // namespace gsv::python
