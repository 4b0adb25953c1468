// The part of the HTTP API with which simulations are put together, see docs/api.yaml.
//
// Errors   {"error": sentence, "field": the field of the request that it concerns}.
// Threads  any.
#pragma once

#include <memory>
#include <string>

#include "gsv/gateway/api/model_store.h"
#include "gsv/gateway/http/http.h"
#include "gsv/gateway/program/simulation_factory.h"

namespace gsv::gateway {

class FactoryApi {
 public:
  // Both outlive this.
  FactoryApi(SimulationFactory& factory, ModelStore& models) : factory_(factory), models_(models) {}

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

 private:
  SimulationFactory& factory_;
  ModelStore& models_;
};

// What needs no factory.
Response RemoveRobot(simulation::Simulation& simulation, const std::string& robot);
Response RemoveObject(simulation::Simulation& simulation, const std::string& object);
Response PlaceBody(simulation::Simulation& simulation, const std::string& name,
                   const std::string& body);

}  // namespace gsv::gateway
