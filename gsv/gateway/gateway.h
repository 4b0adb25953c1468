// The simulations of this program on the web: the viewer's files, an HTTP API, and live data over
// the Foxglove WebSocket protocol at /ws. See docs/formats/live.md and docs/api.yaml.
//
// Threads  its own; the stepping threads of simulations are never waited for, nor do they wait.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/metrics/metrics_page.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/gateway/recordings/replay_sessions.h"
#include "gsv/gateway/server/server.h"
#include "gsv/gateway/uploads/upload_folder.h"

namespace gsv::gateway {

struct GatewayOptions : ServerOptions {
  std::string version;  // of the program, for /metrics
  // Null: /metrics says nothing of the broker.
  std::function<metrics::BrokerCalls()> broker_calls{};
  std::filesystem::path web_root;  // the viewer's files; may be absent
  // Null: nothing is recorded. Outlives the gateway.
  RecordingSwitch* recordings = nullptr;
  // Null: nobody can create a simulation here. Outlives the gateway.
  SimulationFactory* factory = nullptr;
  // The folder whose recordings can be listed and replayed here; empty: none can.
  std::filesystem::path recordings_folder{};
  std::string only_recording{};  // of those in the folder; empty: all
  uploads::UploadLimits uploads{};
  recordings::SessionLimits replays{};
  // By NAME: who answers what is at and below /api/NAME.
  std::map<std::string, std::function<Response(const Request&)>> pages{};
};

class Gateway {
 public:
  // Fails when the port cannot be had.
  static base::Result<std::unique_ptr<Gateway>> Start(
      const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory);
  virtual ~Gateway() = default;

  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // "http://127.0.0.1:8080/"

  // Disconnects all viewers. Waits for requests under way.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
