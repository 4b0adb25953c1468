// A Stream relays one simulation of another instance to the clients of a local hub. It uses one
// WebSocket, with the subscriptions of the local viewers. It is connected while there are viewers,
// and reconnects with growing delays.
//
// Threads  hub() from any; all work is on the thread that runs `io`.
#pragma once

#include <memory>
#include <string>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/upstream/address.h"

namespace boost::asio {
class io_context;
}

namespace gsv::gateway::upstream {

// Relays one simulation of another instance to a local hub.
class Stream {
 public:
  // `simulation`: name of the simulation at the other instance; empty: the first simulation.
  // `socket`: path of the WebSocket, which is "/ws" or the path of a replay's WebSocket.
  // `operations` may be null. `io` must outlive the stream.
  static std::shared_ptr<Stream> Make(boost::asio::io_context& io, const Address& address,
                                      const std::string& simulation, const std::string& socket,
                                      std::shared_ptr<Operations> operations);
  virtual ~Stream() = default;

  virtual const std::shared_ptr<Hub>& hub() const = 0;
  // Disconnects, and does not reconnect. Any thread may call it.
  virtual void Stop() = 0;
  // Whether the simulation has ended and viewers were notified. Any thread may call it.
  virtual bool has_ended() const = 0;
};

}  // namespace gsv::gateway::upstream
