// Api serves the HTTP API of the simulations of this program, under /api/. docs/api.yaml describes
// it.
//
// Threads  any; a request may take as long as its operation (a reset, writing a model).
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

// The HTTP API of the simulations of this program.
class Api {
 public:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;
  // Makes the live stream advertise the topics of a robot's sensors.
  using ListSensors = std::function<void(const SimulationPointer&, const std::string& robot)>;

  // `recordings` and `factory` may be null; otherwise they must outlive this object. `has_replays`:
  // the server also lists and replays recordings.
  Api(std::shared_ptr<SimulationDirectory> directory, ModelStore::WriteGlb write_glb,
      RecordingSwitch* recordings = nullptr, SimulationFactory* factory = nullptr,
      bool has_replays = false, ListSensors list_sensors = nullptr);

  // The handlers are valid during the lifetime of this object.
  std::vector<Route> Routes();

  // Returns the store of the simulations' models.
  ModelStore& models() { return models_; }

 private:
  // Responds with the capabilities of the server.
  Response Server() const;
  // Responds with the list of simulations.
  Response List() const;
  // Responds with the GLB file of a model.
  Response Model(const Request& request);
  // Responds with the scene: the bodies, their models and sensors.
  Response Scene(const SimulationPointer& simulation);
  // Responds with the topics of a robot's sensors.
  Response Topics(const SimulationPointer& simulation, const std::string& robot) const;
  // Responds with the state of the recording.
  Response Recording(const SimulationPointer& simulation) const;
  // Starts or stops a recording.
  Response SwitchRecording(const SimulationPointer& simulation, const std::string& body) const;

  const std::shared_ptr<SimulationDirectory> directory_;
  ModelStore models_;
  RecordingSwitch* const recordings_;
  const bool has_replays_;
  const ListSensors list_sensors_;
  std::optional<FactoryApi> factory_;
};

}  // namespace gsv::gateway
