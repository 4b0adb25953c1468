// GET /metrics: how a server and its simulations are doing, for a monitoring system.
// docs/monitoring.md lists the names.
//
// Labels   come from fixed sets: phases, classes of status. Names that people choose are none.
// Threads  any; asks each simulation for its status once, as a viewer's list does, and never waits
//          for a step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/metrics/traffic.h"
#include "gsv/gateway/program/ports.h"

namespace gsv::gateway::metrics {

// Calls to the broker, since this process started.
struct BrokerCalls {
  std::uint64_t made = 0;
  std::uint64_t failed = 0;
};

struct MetricsSources {
  std::string version;
  // Each may be absent, and then its numbers are.
  SimulationDirectory* directory = nullptr;
  RecordingSwitch* recordings = nullptr;
  std::function<BrokerCalls()> broker_calls{};
};

Response MetricsPage(const MetricsSources& sources, const Traffic& traffic);

// What every server answers at /healthz and /metrics. The handlers live as long as this.
class Monitor {
 public:
  explicit Monitor(MetricsSources sources) : sources_(std::move(sources)) {}

  // To be counted in.
  const std::shared_ptr<Traffic>& traffic() const { return traffic_; }
  std::vector<Route> Routes() const;

 private:
  const MetricsSources sources_;
  const std::shared_ptr<Traffic> traffic_ = std::make_shared<Traffic>();
};

}  // namespace gsv::gateway::metrics
