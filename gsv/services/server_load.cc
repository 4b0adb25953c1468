#include "gsv/services/server_load.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "gsv/broker/encoding/corba_values.h"

namespace gsv::services {
namespace {

constexpr const char* kSimulations = "simulations";
constexpr const char* kLoad = "load";
constexpr const char* kLoadAverage = "load_average";

double Cores() { return std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace

double ServerLoad::Load() const {
  int busy = scenarios_ ? scenarios_() : 0;
  for (const auto& simulation : host_.List()) {
    const simulation::Phase phase = simulation->status().phase;
    busy += phase == simulation::Phase::kStarting || phase == simulation::Phase::kRunning;
  }
  return busy / Cores();
}

CORBA::Any* ServerLoad::evalDP(const char* name, CORBA::TypeCode_ptr type, const CORBA::Any& info) {
  CORBA::Any_var value = new CORBA::Any;
  const std::string_view property(name);
  double average = 0;
  if (property == kSimulations) {
    value.inout() <<= static_cast<CORBA::Long>(host_.List().size());
  } else if (property == kLoad) {
    value.inout() <<= Load();
  } else if (property == kLoadAverage && getloadavg(&average, 1) == 1) {
    value.inout() <<= average / Cores();
  } else {
    throw CosTradingDynamic::DPEvalFailure(name, CORBA::TypeCode::_duplicate(type), info);
  }
  return value._retn();
}

std::vector<broker::Property> ServerLoad::Properties() {
  const auto property = [this](const char* name, CORBA::TypeCode_ptr type) -> broker::Property {
    CosTradingDynamic::DynamicProp dynamic;
    dynamic.eval_if = _this();
    dynamic.returned_type = CORBA::TypeCode::_duplicate(type);
    CORBA::Any any;
    any <<= dynamic;
    return {name, broker::ToValue(any)};
  };
  return {property(kSimulations, CORBA::_tc_long), property(kLoad, CORBA::_tc_double),
          property(kLoadAverage, CORBA::_tc_double)};
}

}  // namespace gsv::services
