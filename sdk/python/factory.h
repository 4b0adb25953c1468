// Makes a BehaviourFactory from a class or another callable in Python.
#pragma once

#include "sdk/behaviour/behaviour.h"
#include "sdk/python/values.h"

namespace gsv::python {

// `make` is called for each robot. Raises TypeError if it is not callable.
BehaviourFactory FactoryFrom(const py::object& make);

}  // namespace gsv::python
