// GET /metrics: metrics of a server and its simulations. docs/monitoring.md lists the names.
//
// Labels   have fixed sets of values (phases, classes of status), never names that users choose.
// Threads  any; queries the status of each simulation once and never waits for a step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/metrics/drawn_views.h"
#include "gsv/gateway/metrics/traffic.h"
#include "gsv/gateway/program/ports.h"

namespace gsv::gateway::metrics {

// Calls to the broker, since this process started.
struct BrokerCalls {
  std::uint64_t made = 0;    // all calls, also the failed ones
  std::uint64_t failed = 0;  // calls that failed
};

// The objects from which GET /metrics reads its numbers.
struct MetricsSources {
  std::string version;  // version of the program
  // Each source may be null. Its metrics are then left out.
  SimulationDirectory* directory = nullptr;
  RecordingSwitch* recordings = nullptr;
  std::function<BrokerCalls()> broker_calls{};
  // Returns null if the server draws no views, for example a relay.
  std::function<std::optional<DrawnViews>()> drawn_views{};
};

// Returns the response to GET /metrics.
Response MetricsPage(const MetricsSources& sources, const Traffic& traffic);

// The routes /healthz and /metrics. The handlers are valid during the lifetime of this object.
class Monitor {
 public:
  explicit Monitor(MetricsSources sources) : sources_(std::move(sources)) {}

  // Returns the counters, which the server updates.
  const std::shared_ptr<Traffic>& traffic() const { return traffic_; }
  std::vector<Route> Routes() const;

 private:
  const MetricsSources sources_;
  const std::shared_ptr<Traffic> traffic_ = std::make_shared<Traffic>();
};

}  // namespace gsv::gateway::metrics
