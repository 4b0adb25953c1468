// RelayedOperations offers the commands of a relayed simulation as services. It forwards them to
// the HTTP API of the other instance.
//
// Threads  any.
#pragma once

#include <string>

#include "gsv/gateway/foxglove/operations.h"
#include "gsv/gateway/live/command_services.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

// The commands of a relayed simulation as services.
class RelayedOperations final : public Operations {
 public:
  // `simulation` is the name of the simulation at the other instance; empty: the first simulation.
  // Requests run on `workers`, which must outlive the last call.
  RelayedOperations(const Address& address, const std::string& simulation, WorkerPool& workers);

  std::vector<foxglove::Service> services() const override { return services_.list(); }
  void Call(const foxglove::ServiceCall& call, Answer answer) override;
  std::vector<foxglove::Parameter> parameters() const override { return {}; }
  base::Status Set(const foxglove::Parameter& parameter) override;

 private:
  WorkerPool& workers_;
  const CommandServices services_;
};

}  // namespace gsv::gateway::upstream
