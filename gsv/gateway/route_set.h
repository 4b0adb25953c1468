// A RouteSet has the routes of one kind of gateway: live simulations, a replay or a relay. The
// Gateway adds the common routes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/gateway/gateway.h"
#include "gsv/gateway/metrics/drawn_views.h"
#include "gsv/gateway/server/worker_pool.h"

namespace gsv::gateway {

// The routes of one kind of gateway.
class RouteSet {
 public:
  virtual ~RouteSet() = default;
  // The handlers are valid during the lifetime of this object.
  virtual std::vector<Route> Routes() = 0;
  // See ViewersApi::CheckControl().
  virtual base::Status CheckControl(const std::string& /*viewer*/,
                                    const std::string& /*simulation*/) {
    return {};
  }
  // Returns the counters of the drawn images; null if the set draws no views. Any thread.
  virtual std::optional<metrics::DrawnViews> drawn_views() { return std::nullopt; }
  // Ends the streams. During this call, handlers may still run and request streams.
  virtual void Stop() {}
};

// These functions make the routes of each kind of gateway. `commanders` runs the commands that come
// over WebSockets, and must outlive the set.
std::unique_ptr<RouteSet> MakeLiveRoutes(const GatewayOptions& options,
                                         std::shared_ptr<SimulationDirectory> directory,
                                         WorkerPool& commanders);
// Makes the routes of a replay.
std::unique_ptr<RouteSet> MakeReplayRoutes(const GatewayOptions& options, ReplayPlayer& player);
// Fails if no gsv answers at the address `there`.
base::Result<std::unique_ptr<RouteSet>> MakeRelayRoutes(const RelayedInstance& there,
                                                        WorkerPool& commanders);

}  // namespace gsv::gateway
