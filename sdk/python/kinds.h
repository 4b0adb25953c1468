// How a class of sensors becomes one of Python's.
#pragma once

#include "sdk/behaviour/sensors.h"
#include "sdk/python/values.h"

namespace gsv::python {

// A class of sensors, whose TYPE is what models call it.
template <typename Kind>
py::class_<Kind> BindKind(py::module_& module, const char* name, py::class_<Sensor>& sensor,
                          const char* description) {
  py::class_<Kind> kind(module, name, sensor, description);
  kind.attr("TYPE") = Kind::kType;
  return kind;
}

void BindActuators(py::module_& module, py::class_<Sensor>& sensor);

}  // namespace gsv::python
