// The type of all WebSockets. Pass only Completions to its operations, and FrameParts to
// async_write(): so each operation is compiled once.
#pragma once

#include <array>

#include <boost/asio/buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "gsv/gateway/transport/byte_stream.h"

namespace gsv::gateway::transport {

// A WebSocket without compression.
using WebSocket = boost::beast::websocket::stream<ByteStream, false>;
// The buffers of one message; they may be empty.
using FrameParts = std::array<boost::asio::const_buffer, 2>;

}  // namespace gsv::gateway::transport
