// A Server listens on one port and serves HTTP and WebSockets, over TLS if it has a certificate.
//
// Threads   one thread serves all connections and never blocks. It calls the Handler, which must
//           return at once.
// Bounded   connections, headers, bodies, messages, send queues, and the time of each exchange.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/access/token_authenticator.h"
#include "gsv/gateway/http/router.h"
#include "gsv/gateway/metrics/traffic.h"
#include "gsv/gateway/server/send_queue.h"

namespace gsv::gateway {

// Limits that protect a server from its clients. Sizes are in bytes.
struct ServerLimits {
  std::size_t connections = 256;           // maximum number of open connections
  std::uint32_t header_bytes = 16u << 10;  // maximum size of a request's header
  std::uint64_t body_bytes = 64u << 10;    // maximum size of a request's body, except uploads
  std::uint64_t upload_bytes = 64u << 20;  // maximum size of one file
  std::size_t uploads_at_once = 4;         // an upload is in memory until it is complete
  std::size_t message_bytes = 256u << 10;  // maximum size of one WebSocket message from a client
  // time limit to send a request, or to receive the response
  std::chrono::milliseconds request_time{30'000};
  // Time without an answer to pings after which a viewer is disconnected.
  std::chrono::milliseconds idle_time{60'000};
  SendLimits send;  // limits of the queue to each client
};

// Names of PEM files; either both names are set, or neither.
struct TlsFiles {
  std::string certificate, key;  // certificate with its chain, and private key

  bool empty() const { return certificate.empty() && key.empty(); }
};

// The address, permissions and limits of a Server.
struct ServerOptions {
  std::string host = "127.0.0.1";          // an address of this machine, or "localhost"
  std::uint16_t port = 0;                  // 0 if the system chooses
  std::vector<std::string> allowed_hosts;  // see AccessRule
  std::vector<std::string> allowed_origins;
  // If there are no tokens and no authenticator, only this machine is served.
  access::Tokens tokens;
  std::shared_ptr<access::Authenticator> authenticator{};  // replaces the tokens, if set
  TlsFiles tls{};                                          // empty: plain HTTP
  ServerLimits limits;
  std::shared_ptr<metrics::Traffic> traffic{};  // counters; null if nothing is counted
};

// Handles the requests that reach a server, after the server has found their route and checked
// their permission.
class Handler {
 public:
  virtual ~Handler() = default;
  // The routes by which the server finds the handler of a request.
  virtual const Router& router() const = 0;
  // Runs the handler of the route, on the threads that the route names. `respond` must be called
  // once, now or later, from any thread, before the server is stopped.
  virtual void Handle(const Route& route, Request request, Respond respond) = 0;
  // Returns an error with the reason if the viewer with this key (empty: none) may not control the
  // simulation now; see ViewerRegistry.
  virtual base::Status CheckControl(const std::string& /*viewer*/,
                                    const std::string& /*simulation*/) {
    return {};
  }
};

// Serves HTTP and WebSockets on one port.
class Server {
 public:
  // Starts a server. `handler` must outlive it. Fails if the port is not available or the
  // certificate is invalid, and with kInvalidArgument if other machines could connect without
  // credentials.
  static base::Result<std::unique_ptr<Server>> Start(const ServerOptions& options,
                                                     Handler& handler);
  virtual ~Server() = default;

  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // "http://127.0.0.1:8080/"

  // Closes all connections with a closing handshake, and forcibly after a short time. Idempotent.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
