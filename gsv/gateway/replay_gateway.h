// A recording on the web: the same addresses and messages as the gateway of a running simulation,
// so that the same viewer shows it.
//
// Threads  its own.
#pragma once

#include <memory>
#include <string>

#include "gsv/gateway/gateway.h"
#include "gsv/gateway/replay/replay_player.h"

namespace gsv::gateway {

class ReplayGateway {
 public:
  // `player` outlives this. Fails when the port cannot be had.
  static base::Result<std::unique_ptr<ReplayGateway>> Start(const GatewayOptions& options,
                                                            ReplayPlayer& player);
  virtual ~ReplayGateway() = default;

  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // "http://127.0.0.1:8080/"

  // Disconnects all viewers. Waits for requests under way.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
