// A Gateway is gsv's web server. It serves the viewer's files, the documentation at /docs/, an HTTP
// API, and live data over the Foxglove WebSocket protocol at /ws. See docs/formats/live.md and
// docs/api.yaml.
//
// A gateway has one of three sets of routes: the simulations of this program; a recording that is
// replayed; or another instance whose simulations are relayed. All three sets have the same
// addresses and messages, so that the same viewer shows them.
//
// Threads  the gateway has its own threads. They and the stepping threads never wait for each
//          other.
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

// Options for all kinds of gateways.
struct GatewayOptions : ServerOptions {
  std::string version;  // version of the program, for /metrics
  // If null, /metrics has no numbers of the broker.
  std::function<metrics::BrokerCalls()> broker_calls{};
  std::filesystem::path web_root;     // the viewer's files; may be absent
  std::filesystem::path docs_root{};  // the documentation's files; may be absent
  // Null if recording is not available. Otherwise, the object must outlive the gateway.
  RecordingSwitch* recordings = nullptr;
  // Null if simulations cannot be created. Otherwise, the object must outlive the gateway.
  SimulationFactory* factory = nullptr;
  // The folder of recordings to list and replay; empty: none.
  std::filesystem::path recordings_folder{};
  std::string only_recording{};     // a single file of the folder that is served; empty: all files
  uploads::UploadLimits uploads{};  // limits of uploaded files
  recordings::SessionLimits replays{};  // limits of open replays
  // Maximum size in bytes of the history of each simulation (recording/run_history.h). If it is 0,
  // or recordings_folder is empty, there is no history.
  std::size_t history_bytes = 0;
  std::vector<Route> routes{};  // additional routes, for simulations of this program
};

// An instance whose simulations are relayed.
struct RelayedInstance {
  // the address that the other instance prints, such as "http://192.168.1.7:8080/"
  std::string url;
  std::string token{};      // sent to the other instance in all requests; empty: none
  std::string authority{};  // a PEM file with the certificates to trust; empty: the system's
};

// GSV's web server.
class Gateway {
 public:
  // Serves the simulations of this program. Start(), StartReplay() and StartRelay() fail if the
  // port is not available.
  static base::Result<std::unique_ptr<Gateway>> Start(
      const GatewayOptions& options, std::shared_ptr<SimulationDirectory> directory);
  // Serves a recording. `player` must outlive the gateway.
  static base::Result<std::unique_ptr<Gateway>> StartReplay(const GatewayOptions& options,
                                                            ReplayPlayer& player);
  // Relays another instance: serves the viewer's files, forwards requests, and opens one stream per
  // watched simulation, whatever the number of viewers here. Connects once, and fails if no gsv
  // answers. If the instance disappears later, the relay reconnects.
  static base::Result<std::unique_ptr<Gateway>> StartRelay(const GatewayOptions& options,
                                                           const RelayedInstance& there);
  virtual ~Gateway() = default;

  // The routes of this gateway.
  virtual const Router& router() const = 0;
  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // "http://127.0.0.1:8080/"

  // Disconnects all viewers. Waits for pending requests.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
