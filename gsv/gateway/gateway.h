// Simulations, a recording or another instance on the web: the viewer's files, the documentation
// at /docs/, an HTTP API, and live data over the Foxglove WebSocket protocol at /ws. See
// docs/formats/live.md and docs/api.yaml.
//
// There is one gateway, with one of three sets of routes: of the simulations of this program, of a
// recording that is replayed (the same addresses and messages, so that the same viewer shows it),
// or of another instance whose simulations are relayed.
//
// Threads  its own; the stepping threads of simulations are never waited for, nor do they wait.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/http/router.h"
#include "gsv/gateway/metrics/metrics_page.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/gateway/recordings/replay_sessions.h"
#include "gsv/gateway/replay/replay_player.h"
#include "gsv/gateway/server/server.h"
#include "gsv/gateway/uploads/upload_folder.h"

namespace gsv::gateway {

struct GatewayOptions : ServerOptions {
  std::string version;  // of the program, for /metrics
  // Null: /metrics says nothing of the broker.
  std::function<metrics::BrokerCalls()> broker_calls{};
  std::filesystem::path web_root;     // the viewer's files; may be absent
  std::filesystem::path docs_root{};  // the documentation's files; may be absent
  // Null: nothing is recorded. Outlives the gateway.
  RecordingSwitch* recordings = nullptr;
  // Null: nobody can create a simulation here. Outlives the gateway.
  SimulationFactory* factory = nullptr;
  // The folder whose recordings can be listed and replayed here; empty: none can.
  std::filesystem::path recordings_folder{};
  std::string only_recording{};  // of those in the folder; empty: all
  uploads::UploadLimits uploads{};
  recordings::SessionLimits replays{};
  std::vector<Route> routes{};  // further ones, beside those of the simulations of this program
};

// An instance whose simulations are relayed.
struct RelayedInstance {
  std::string url;          // as it printed it: "http://192.168.1.7:8080/"
  std::string token{};      // shown there on behalf of all clients of the relay; empty: none
  std::string authority{};  // a PEM file with the certificates to trust; empty: the system's
};

class Gateway {
 public:
  // Of the simulations of this program. All three fail when the port cannot be had.
  static base::Result<std::unique_ptr<Gateway>> Start(
      const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory);
  // Of a recording. `player` outlives the gateway.
  static base::Result<std::unique_ptr<Gateway>> StartReplay(const GatewayOptions& options,
                                                            ReplayPlayer& player);
  // Of another instance: the viewer's files are our own, requests are forwarded, and of each
  // simulation that is watched there is one stream, however many viewers watch here. Asks there
  // once, and fails when no gsv answers. If the instance goes away later, it is waited for.
  static base::Result<std::unique_ptr<Gateway>> StartRelay(const GatewayOptions& options,
                                                           const RelayedInstance& there);
  virtual ~Gateway() = default;

  virtual const Router& router() const = 0;
  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // "http://127.0.0.1:8080/"

  // Disconnects all viewers. Waits for requests under way.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
