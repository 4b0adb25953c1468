// Another instance's simulations, for viewers of this one: the viewer's files are our own, requests
// are passed on, and of each simulation that is watched there is one stream from there, however
// many watch here.
//
// Threads  its own.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "gsv/gateway/gateway.h"

namespace gsv::gateway {

class Relay {
 public:
  // `upstream_url` is what the other instance printed: "http://192.168.1.7:8080/". Asks there once;
  // fails when that is not answered by a gsv, or when the port cannot be had. An instance that goes
  // away later is waited for. `token` is shown there on behalf of all who come here.
  static base::Result<std::unique_ptr<Relay>> Start(const GatewayOptions& options,
                                                    std::string_view upstream_url,
                                                    std::string token = {});
  virtual ~Relay() = default;

  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // of this instance

  // Disconnects all viewers. Waits for requests under way.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
