// The HTTP API under /api/: what there is to see, and the buttons. Described in docs/api.yaml.
//
// Threads  any; a request may take as long as what it asks for (a reset, a model to be written).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gsv/gateway/api/factory_api.h"
#include "gsv/gateway/api/model_store.h"
#include "gsv/gateway/http/http.h"
#include "gsv/gateway/program/ports.h"

namespace gsv::gateway {

class Api {
 public:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;
  // Has the live stream list the topics of a robot's sensors, whatever it has besides.
  using ListSensors = std::function<void(const SimulationPointer&, const std::string& robot)>;

  // `recordings` and `factory` may be null; else they outlive this. `has_replays`: recordings can
  // be listed and replayed here as well.
  Api(std::shared_ptr<SimulationDirectory> directory, ModelStore::WriteGlb write_glb,
      RecordingSwitch* recordings = nullptr, SimulationFactory* factory = nullptr,
      bool has_replays = false, ListSensors list_sensors = nullptr);

  // `request.target` begins with "api".
  Response Handle(const Request& request);

 private:
  Response Server() const;
  Response OfFactory(const Request& request) const;
  Response List() const;
  Response OfSimulation(const Request& request);
  Response OfBody(const Request& request, const SimulationPointer& simulation) const;
  Response Topics(const SimulationPointer& simulation, const std::string& robot) const;
  Response Scene(const simulation::Simulation& simulation);
  Response Recording(const Request& request, const SimulationPointer& simulation) const;

  const std::shared_ptr<SimulationDirectory> directory_;
  ModelStore models_;
  RecordingSwitch* const recordings_;
  const bool has_replays_;
  const ListSensors list_sensors_;
  std::optional<FactoryApi> factory_;
};

}  // namespace gsv::gateway
