// The HTTP API under /api/: what there is to see, and the buttons. Described in docs/api.yaml.
//
// Threads  any; a request may take as long as what it asks for (a reset, a model to be written).
#pragma once

#include <memory>
#include <string>

#include "gsv/gateway/http.h"
#include "gsv/gateway/model_store.h"
#include "gsv/gateway/ports.h"

namespace gsv::gateway {

class Api {
 public:
  // `recordings` may be null; else it outlives this.
  Api(std::shared_ptr<SimulationDirectory> directory, ModelStore::WriteGlb write_glb,
      RecordingSwitch* recordings = nullptr);

  // `request.target` begins with "api".
  Response Handle(const Request& request);

 private:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;

  Response List() const;
  Response OfSimulation(const Request& request);
  Response OfRobot(const Request& request, const SimulationPointer& simulation) const;
  Response Scene(const simulation::Simulation& simulation);
  Response Recording(const Request& request, const SimulationPointer& simulation) const;
  Response Model(const Request& request);

  const std::shared_ptr<SimulationDirectory> directory_;
  ModelStore models_;
  RecordingSwitch* const recordings_;
};

}  // namespace gsv::gateway
