// One simulation on another instance, as a hub here: a single WebSocket to there, subscribed to
// what the viewers here want. Connected while somebody watches; when the connection breaks, it is
// tried again, a little later each time.
//
// Threads  hub() from any; everything happens on the thread that runs `io`.
#pragma once

#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

class Stream {
 public:
  // `simulation`: its name there; empty: the first. `socket`: where it is streamed, "/ws" or that
  // of a replay. `operations` is what viewers can do; null: nothing. `io` outlives the stream.
  static std::shared_ptr<Stream> Make(boost::asio::io_context& io, const Address& address,
                                      const std::string& simulation, const std::string& socket,
                                      std::shared_ptr<Operations> operations);
  virtual ~Stream() = default;

  virtual const std::shared_ptr<Hub>& hub() const = 0;
  // Disconnects, for good. Any thread.
  virtual void Stop() = 0;
  // The simulation is not there any more, and the viewers were told. Any thread.
  virtual bool has_ended() const = 0;
};

}  // namespace gsv::gateway::upstream
