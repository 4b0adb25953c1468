// Provides the load of a server as dynamic properties of the server's offers. The broker evaluates
// these properties in queries.
//
//   simulations   long    number of simulations
//   load          double  number of advancing simulations and running scenarios, divided by the
//                         number of the machine's cores
//   load_average  double  load of the whole machine over the last minute, divided by its cores
//
// Threads  ORB threads.
#pragma once

#include <functional>
#include <vector>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/language/property.h"
#include "gsv/services/simulation_host.h"

namespace gsv::services {

class ServerLoad final : public POA_CosTradingDynamic::DynamicPropEval {
 public:
  // `host` must outlive the object. `scenarios` returns the number of running scenarios; it may be
  // empty.
  ServerLoad(const SimulationHost& host, std::function<int()> scenarios)
      : host_(host), scenarios_(std::move(scenarios)) {}

  CORBA::Any* evalDP(const char* name, CORBA::TypeCode_ptr type, const CORBA::Any& info) override;

  // Returns the properties to export. The object must be active.
  std::vector<broker::Property> Properties();

 private:
  double Load() const;  // the value of the property `load`

  const SimulationHost& host_;
  const std::function<int()> scenarios_;
};

}  // namespace gsv::services
