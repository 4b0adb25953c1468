// FactoryApi is the part of the HTTP API that creates and edits simulations (docs/api.yaml).
//
// Errors   {"error": sentence, "field": field of the request}.
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

// The part of the HTTP API that creates and edits simulations.
class FactoryApi {
 public:
  // `factory` and `models` must outlive this object.
  FactoryApi(SimulationFactory& factory, ModelStore& models) : factory_(factory), models_(models) {}

  // Returns the routes. The handlers are valid during the lifetime of this object. `directory`
  // finds the simulations.
  std::vector<Route> Routes(const std::shared_ptr<SimulationDirectory>& directory);

 private:
  // These functions respond with lists of the available worlds, models and behaviours.
  Response Worlds() const;
  Response Models() const;
  Response Behaviours(const Target& target) const;
  // Responds whether simulations can be published to ROS 2.
  Response Ros2() const;

  // Responds with the scene and poses of a simulation without creating it.
  Response Preview(const std::string& body) const;
  // Creates a simulation.
  Response Create(const std::string& body) const;
  // Destroys a simulation.
  Response Destroy(const std::string& simulation) const;
  // Adds a robot or an avatar.
  Response AddRobot(const std::shared_ptr<simulation::Simulation>& simulation,
                    const std::string& body) const;
  // Responds with the texts of a world file and a scenario file.
  Response SaveWorld(const std::shared_ptr<simulation::Simulation>& simulation,
                     const Target& target) const;
  // Adds an object.
  Response AddObject(const std::shared_ptr<simulation::Simulation>& simulation,
                     const std::string& body) const;

  SimulationFactory& factory_;
  ModelStore& models_;
};

// Returns the response to a refused request: {"error": sentence, "field": field of the request}.
// The status is 422 for kBadModel, kBehaviour and kNotFound. Other errors have the same status as
// in ErrorResponse().
Response Refusal(const FieldError& wrong);

}  // namespace gsv::gateway
