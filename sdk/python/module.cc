// The module gsv._native, the SDK in Python. Users import the package gsv (sdk/python/gsv).
#include "gsv/base/log.h"
#include "sdk/python/values.h"

PYBIND11_MODULE(_native, module) {
  using namespace gsv::python;
  module.doc() = "The C++ side of gsv; import gsv instead.";
  module.attr("__version__") = GSV_VERSION;
  gsv::base::InitLogging(spdlog::level::info);
  BindSensors(module);
  BindRobot(module);
  BindBehaviours(module);
  BindApplications(module);
}
