// The HTTP API of the simulations of this program, under /api/. Described in docs/api.yaml.
//
// Threads  any; a request may take as long as what it asks for (a reset, a model to be written).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/gateway/api/factory_api.h"
#include "gsv/gateway/api/model_store.h"
#include "gsv/gateway/http/route.h"
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

  // The handlers live as long as this.
  std::vector<Route> Routes();

 private:
  Response Server() const;
  Response List() const;
  Response Model(const Request& request);
  Response Scene(const SimulationPointer& simulation);
  Response Topics(const SimulationPointer& simulation, const std::string& robot) const;
  Response Recording(const SimulationPointer& simulation) const;
  Response SwitchRecording(const SimulationPointer& simulation, const std::string& body) const;

  const std::shared_ptr<SimulationDirectory> directory_;
  ModelStore models_;
  RecordingSwitch* const recordings_;
  const bool has_replays_;
  const ListSensors list_sensors_;
  std::optional<FactoryApi> factory_;
};

}  // namespace gsv::gateway
