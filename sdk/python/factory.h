// Behaviours in Python for who runs behaviours.
#pragma once

#include "sdk/behaviour/behaviour.h"
#include "sdk/python/values.h"

namespace gsv::python {

// `make` is called for each robot; TypeError where it cannot be.
BehaviourFactory FactoryFrom(const py::object& make);

}  // namespace gsv::python
