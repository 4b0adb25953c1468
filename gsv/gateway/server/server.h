// Listens on one port; speaks HTTP and WebSocket with those who connect, over TLS if it has a
// certificate.
//
// Threads   one thread serves all connections and never waits for anybody. A Handler is called on
//           it and returns at once.
// Bounded   connections, headers, bodies, messages, what waits for a client, and the time each
//           exchange may take.
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

struct ServerLimits {
  std::size_t connections = 256;
  std::uint32_t header_bytes = 16u << 10;
  std::uint64_t body_bytes = 64u << 10;
  std::uint64_t upload_bytes = 64u << 20;          // of one file
  std::size_t uploads_at_once = 4;                 // each in memory until it is there
  std::size_t message_bytes = 256u << 10;          // of one WebSocket message from a client
  std::chrono::milliseconds request_time{30'000};  // to send a request, or to take its answer
  std::chrono::milliseconds idle_time{60'000};  // a viewer that answers no ping for so long is gone
  SendLimits send;
};

// PEM files. Both or none.
struct TlsFiles {
  std::string certificate, key;  // with the certificates that lead to the authority's; the key

  bool empty() const { return certificate.empty() && key.empty(); }
};

struct ServerOptions {
  std::string host = "127.0.0.1";          // an address of this machine, or "localhost"
  std::uint16_t port = 0;                  // 0: the system chooses
  std::vector<std::string> allowed_hosts;  // see AccessRule
  std::vector<std::string> allowed_origins;
  // Without a token, and without an authenticator, only this machine is served.
  access::Tokens tokens;
  std::shared_ptr<access::Authenticator> authenticator{};  // in place of the tokens; null: they are
  TlsFiles tls{};                                          // empty: plain HTTP
  ServerLimits limits;
  std::shared_ptr<metrics::Traffic> traffic{};  // where it is counted; null: nowhere that is seen
};

// What a server serves. Requests that no route is for, or that lack permission, do not get here.
class Handler {
 public:
  virtual ~Handler() = default;
  virtual const Router& router() const = 0;
  // Has the route's handler answer, on the threads that the route names. `respond` must be called
  // once, here or later, from any thread, before the server is stopped.
  virtual void Handle(const Route& route, Request request, Respond respond) = 0;
  // Why the viewer of this key (empty: none) may not control that simulation now; see ViewerRegistry.
  virtual base::Status CheckControl(const std::string& /*viewer*/,
                                    const std::string& /*simulation*/) {
    return {};
  }
};

class Server {
 public:
  // `handler` outlives the server. Fails when the port cannot be had or the certificate cannot be
  // used, and with kInvalidArgument when other machines could reach it and need no credentials.
  static base::Result<std::unique_ptr<Server>> Start(const ServerOptions& options,
                                                     Handler& handler);
  virtual ~Server() = default;

  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // "http://127.0.0.1:8080/"

  // Says goodbye to all, waits a moment for them to go, then cuts them off. May be called again.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
