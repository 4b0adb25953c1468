// LiveOperations offers the operations on a running simulation to its viewers. Commands and
// recording are services. The specification and the target real-time factor are parameters.
//
// Threads  any.
#pragma once

#include <memory>

#include "gsv/gateway/foxglove/operations.h"
#include "gsv/gateway/live/command_services.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// The operations on a running simulation.
class LiveOperations final : public Operations {
 public:
  // Commands may block, so they run on `workers`. `workers` must outlive the last call. Does not
  // keep the simulation alive. `recordings` may be null: then recording is not available.
  LiveOperations(const std::shared_ptr<simulation::Simulation>& simulation, WorkerPool& workers,
                 RecordingSwitch* recordings);

  std::vector<foxglove::Service> services() const override { return services_.list(); }
  void Call(const foxglove::ServiceCall& call, Answer answer) override;
  std::vector<foxglove::Parameter> parameters() const override;
  base::Status Set(const foxglove::Parameter& parameter) override;

 private:
  base::Status SetRealTimeFactor(const foxglove::ParameterValue& value);

  const std::weak_ptr<simulation::Simulation> simulation_;
  WorkerPool& workers_;
  RecordingSwitch* const recordings_;
  const CommandServices services_;
  const std::vector<foxglove::Parameter> fixed_;  // parameters that cannot be set
};

}  // namespace gsv::gateway
