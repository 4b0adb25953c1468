// Where a command's viewer is served, and what it may show beside simulations.
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

// Groups of options in the help of commands that serve a viewer.
inline constexpr const char* kViewerGroup = "Viewer";
inline constexpr const char* kNetworkGroup = "Network and security";

struct ViewerOptions {
  int port = -1;           // 0: the system chooses; -1: the usual one, or another if it is in use
  std::string recordings;  // a folder; empty: the current one
  std::string listen = "127.0.0.1";  // an address of this machine
  std::vector<std::string> names;    // of this machine, under which the viewer may be opened
  gateway::access::Tokens tokens;
  gateway::TlsFiles tls;
};

// Adds --port, --listen, --allow-host, --control-token, --watch-token, --tls-certificate and
// --tls-key.
void AddViewerOptions(CLI::App& command, ViewerOptions& options);
// Adds --recordings, where simulations run.
void AddRecordingsOption(CLI::App& command, ViewerOptions& options);
// Adds --broker, of a command that starts a broker where none is named.
void AddBrokerOption(CLI::App& command, std::string& broker);

// Starts a gateway where it was asked for; `gateway` holds the rest.
base::Result<std::unique_ptr<gateway::Gateway>> StartViewer(
    const ViewerOptions& options, gateway::GatewayOptions gateway,
    const std::function<
        base::Result<std::unique_ptr<gateway::Gateway>>(const gateway::GatewayOptions&)>& start);

}  // namespace gsv::app
