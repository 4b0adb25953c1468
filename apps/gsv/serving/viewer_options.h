// The options of commands that serve the viewer: address, tokens, certificate, recordings and
// history.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/gateway.h"

namespace CLI {
class App;
}

namespace gsv::app {

// The groups of options in the help of commands that serve a viewer.
inline constexpr const char* kViewerGroup = "Viewer";
inline constexpr const char* kNetworkGroup = "Network and security";

// The address and the security of a viewer's server.
struct ViewerOptions {
  // 0: the system chooses the port; -1: the default port, or another port if that is in use.
  int port = -1;
  std::string recordings;            // a folder; empty for the current one
  int history_mib = 64;              // maximum size of each simulation's history, MiB; 0: none
  std::string listen = "127.0.0.1";  // an address of this machine
  std::vector<std::string> names;    // host names of this machine that browsers may use
  gateway::access::Tokens tokens;    // tokens that clients must show; empty: none
  gateway::TlsFiles tls;             // certificate and key for HTTPS; empty for HTTP
};

// Adds --port, --listen, --allow-host, --control-token, --watch-token, --tls-certificate and
// --tls-key.
void AddViewerOptions(CLI::App& command, ViewerOptions& options);
// Adds --recordings and --history, for commands that run simulations.
void AddRecordingsOption(CLI::App& command, ViewerOptions& options);
// Adds --broker, for commands that start a broker if none is given.
void AddBrokerOption(CLI::App& command, std::string& broker);

// Starts the gateway, with the address, tokens and certificate from `options`, and everything else
// from `gateway`.
base::Result<std::unique_ptr<gateway::Gateway>> StartViewer(
    const ViewerOptions& options, gateway::GatewayOptions gateway,
    const std::function<
        base::Result<std::unique_ptr<gateway::Gateway>>(const gateway::GatewayOptions&)>& start);

}  // namespace gsv::app
