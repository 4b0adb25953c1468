// The module gsv._native, the SDK in Python. Users import the package gsv (sdk/python/gsv).
#include "gsv/base/log.h"
#include "sdk/python/values.h"

PYBIND11_MODULE(_native, module) {
  using namespace gsv::python;
  module.doc() =
      "The part of gsv in C++. Import the package gsv, which contains this module's names.";
  module.attr("__version__") = GSV_VERSION;
  gsv::base::InitLogging(spdlog::level::info);
  BindSensors(module);
  BindRobot(module);
  BindBehaviours(module);
  BindApplications(module);
}
