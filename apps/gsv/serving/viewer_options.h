// Options for the viewer of a command: its address, and what it may show besides simulations.
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
  int port = -1;                     // 0: the system chooses; -1: the default, or another if in use
  std::string recordings;            // a folder; empty: the current one
  std::string listen = "127.0.0.1";  // an address of this machine
  std::vector<std::string> names;    // names of this machine that browsers may use for it
  gateway::access::Tokens tokens;
  gateway::TlsFiles tls;
};

// Adds --port, --listen, --allow-host, --control-token, --watch-token, --tls-certificate and
// --tls-key.
void AddViewerOptions(CLI::App& command, ViewerOptions& options);
// Adds --recordings, for commands that run simulations.
void AddRecordingsOption(CLI::App& command, ViewerOptions& options);
// Adds --broker, for commands that start a broker if none is given.
void AddBrokerOption(CLI::App& command, std::string& broker);

// Starts a gateway if it was requested; `gateway` has the rest of its options.
base::Result<std::unique_ptr<gateway::Gateway>> StartViewer(
    const ViewerOptions& options, gateway::GatewayOptions gateway,
    const std::function<
        base::Result<std::unique_ptr<gateway::Gateway>>(const gateway::GatewayOptions&)>& start);

}  // namespace gsv::app
