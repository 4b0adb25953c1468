// Another instance's simulations, for viewers of this one: the viewer's files are our own, requests
// are passed on, and of each simulation that is watched there is one stream from there, however
// many watch here.
//
// Threads  its own.
#pragma once

#include <memory>
#include <string>

#include "gsv/gateway/gateway.h"

namespace gsv::gateway {

class Relay {
 public:
  struct Instance {
    std::string url;      // what it printed: "http://192.168.1.7:8080/"
    std::string token{};  // shown there on behalf of all who come here; empty: none
    std::string
        authority{};  // whom to trust where it speaks HTTPS, a PEM file; empty: the system's
  };
  // Asks there once; fails when that is not answered by a gsv, or when the port cannot be had. An
  // instance that goes away later is waited for.
  static base::Result<std::unique_ptr<Relay>> Start(const GatewayOptions& options,
                                                    const Instance& there);
  virtual ~Relay() = default;

  virtual std::uint16_t port() const = 0;
  virtual std::string url() const = 0;  // of this instance

  // Disconnects all viewers. Waits for requests under way.
  virtual void Stop() = 0;
};

}  // namespace gsv::gateway
