// A ByteStream is a connection with or without TLS, as one type that satisfies Boost.Beast's
// concept AsyncStream. Handlers are type-erased as well. So the operations of TCP and TLS are
// compiled once, in byte_stream.cc, which saves most of the build time.
//
// Threads  the thread of the executor.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream_base.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/container/static_vector.hpp>

#include "gsv/gateway/transport/completion.h"

namespace gsv::gateway::transport {

// The buffers of one write. If a sequence has more than 16 buffers, only the first 16 are written.
// An HTTP response has about 12.
using Parts = boost::container::static_vector<boost::asio::const_buffer, 16>;

// A connection with or without TLS.
class ByteStream {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;
  using error_code = boost::system::error_code;
  using Tls = boost::beast::ssl_stream<boost::beast::tcp_stream>;

  // Creates a stream that is not connected yet.
  explicit ByteStream(boost::asio::io_context& io) : plain_(std::in_place, io) {}
  explicit ByteStream(boost::asio::ip::tcp::socket socket)
      : plain_(std::in_place, std::move(socket)) {}

  // Returns the TCP stream below TLS, to connect, limit and close it.
  boost::beast::tcp_stream& tcp() { return tls_ ? tls_->next_layer() : *plain_; }
  executor_type get_executor() { return tcp().get_executor(); }

  // Enables TLS. Call Handshake() afterwards. `context` must outlive the stream.
  Tls& StartTls(boost::asio::ssl::context& context);
  // Call StartTls() first. `already_read` has bytes that were read from the connection before.
  // `then` gets the number of these bytes that the handshake used.
  void Handshake(boost::asio::ssl::stream_base::handshake_type type,
                 boost::asio::const_buffer already_read, Completion then);
  // Shuts TLS down. Without TLS, calls then() at once.
  void Shutdown(Completion then);

  // These functions read or write some bytes, at least one, and call `then`.
  void ReadSome(boost::asio::mutable_buffer into, Completion then);
  void WriteSome(const Parts& parts, Completion then);
  // Shuts the connection down after the closing handshake of a WebSocket. Boost.Beast calls this.
  void Teardown(boost::beast::role_type role, Completion then);

  // Implements the concept AsyncReadStream of Boost.Beast.
  template <typename Buffers, typename Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(error_code, std::size_t)>(
        [this](auto&& handler, boost::asio::mutable_buffer into) {
          ReadSome(into, Completion(std::forward<decltype(handler)>(handler)));
        },
        token, FirstOf(buffers));
  }
  template <typename Buffers, typename Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(error_code, std::size_t)>(
        [this](auto&& handler, const Parts& parts) {
          WriteSome(parts, Completion(std::forward<decltype(handler)>(handler)));
        },
        token, PartsOf(buffers));
  }
  template <typename Handler>
  friend void async_teardown(boost::beast::role_type role, ByteStream& stream, Handler&& handler) {
    stream.Teardown(role, Completion(std::forward<Handler>(handler)));
  }
  friend void beast_close_socket(ByteStream& stream) { stream.tcp().close(); }

 private:
  template <typename Buffers>
  // Returns the first buffer that is not empty.
  static boost::asio::mutable_buffer FirstOf(const Buffers& buffers) {
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto part = boost::asio::buffer_sequence_begin(buffers); part != end; ++part) {
      const boost::asio::mutable_buffer buffer = *part;
      if (buffer.size() > 0) return buffer;
    }
    return {};
  }
  template <typename Buffers>
  // Returns the buffers that are not empty, at most as many as Parts can have.
  static Parts PartsOf(const Buffers& buffers) {
    Parts parts;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto part = boost::asio::buffer_sequence_begin(buffers);
         part != end && parts.size() < parts.capacity(); ++part) {
      const boost::asio::const_buffer buffer = *part;
      if (buffer.size() > 0) parts.push_back(buffer);
    }
    return parts;
  }

  std::optional<boost::beast::tcp_stream> plain_;  // until StartTls()
  std::unique_ptr<Tls> tls_;                       // since StartTls(); null for plain TCP
};

}  // namespace gsv::gateway::transport
