// A Connector resolves the name of a host and connects a ByteStream to it.
//
// Threads  the thread that runs the io_context.
#pragma once

#include <chrono>
#include <string>

#include "gsv/gateway/transport/byte_stream.h"

namespace gsv::gateway::transport {

// Resolves and connects. The Connector and the stream must exist until the operation ends.
class Connector {
 public:
  explicit Connector(boost::asio::io_context& io) : resolver_(io) {}

  // Connects `stream` to `host`, a name or an address, and calls `then`. `limit` is the time limit
  // for the connection and for what follows on the stream; see TcpStream::expires_after().
  void Connect(ByteStream& stream, const std::string& host, const std::string& port,
               std::chrono::milliseconds limit, Completion then);
  // Cancels the resolution of the name. To cancel the connection, also close the stream.
  void Cancel();

 private:
  Resolver resolver_;
  bool is_cancelled_ = false;
};

}  // namespace gsv::gateway::transport
