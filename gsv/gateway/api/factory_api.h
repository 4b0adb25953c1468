// The part of the HTTP API with which simulations are put together, see docs/api.yaml.
//
// Errors   {"error": sentence, "field": the field of the request that it concerns}.
// Threads  any.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/api/model_store.h"
#include "gsv/gateway/http/route.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/gateway/program/simulation_factory.h"

namespace gsv::gateway {

class FactoryApi {
 public:
  // Both outlive this.
  FactoryApi(SimulationFactory& factory, ModelStore& models) : factory_(factory), models_(models) {}

  // The handlers live as long as this. `directory` finds the simulations that are changed.
  std::vector<Route> Routes(const std::shared_ptr<SimulationDirectory>& directory);

 private:
  // What there is to choose from.
  Response Worlds() const;
  Response Models() const;
  Response Behaviours(const Target& target) const;

  Response Preview(const std::string& body) const;
  Response Create(const std::string& body) const;
  Response Destroy(const std::string& simulation) const;
  Response AddRobot(const std::shared_ptr<simulation::Simulation>& simulation,
                    const std::string& body) const;
  Response AddObject(const std::shared_ptr<simulation::Simulation>& simulation,
                     const std::string& body) const;

  SimulationFactory& factory_;
  ModelStore& models_;
};

// To a request that was understood and cannot be done: 422 or as everywhere, with the field.
Response Refusal(const FieldError& wrong);

}  // namespace gsv::gateway
