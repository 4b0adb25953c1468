// What a gateway serves beside what all gateways have in common.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/gateway.h"
#include "gsv/gateway/server/worker_pool.h"

namespace gsv::gateway {

class RouteSet {
 public:
  virtual ~RouteSet() = default;
  // Their handlers live as long as this.
  virtual std::vector<Route> Routes() = 0;
  // See Handler.
  virtual base::Status CheckControl(const std::string& /*viewer*/,
                                    const std::string& /*simulation*/) {
    return {};
  }
  // Ends the streams. Handlers may still be running, and streams be asked for.
  virtual void Stop() {}
};

// `commanders` runs what viewers command over their WebSockets, and outlives the set.
std::unique_ptr<RouteSet> MakeLiveRoutes(const GatewayOptions& options,
                                         std::shared_ptr<SimulationDirectory> directory,
                                         WorkerPool& commanders);
std::unique_ptr<RouteSet> MakeReplayRoutes(const GatewayOptions& options, ReplayPlayer& player);
// Fails when no gsv answers there.
base::Result<std::unique_ptr<RouteSet>> MakeRelayRoutes(const RelayedInstance& there,
                                                        WorkerPool& commanders);

}  // namespace gsv::gateway
