// A ByteStream is a connection with or without TLS, as one type that satisfies Boost.Beast's
// concept AsyncStream. Handlers are type-erased as well. So the operations of TCP and TLS are
// compiled once, in byte_stream.cc, which saves most of the build time.
//
// Threads  the thread of the executor.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/container/static_vector.hpp>

#include "gsv/gateway/transport/completion.h"
#include "gsv/gateway/transport/tcp.h"

namespace gsv::gateway::transport {

// The buffers of one write. If a sequence has more than 16 buffers, only the first 16 are written.
// The response to the handshake of a WebSocket has about 12.
using Parts = boost::container::static_vector<boost::asio::const_buffer, 16>;

// A connection without TLS, with type-erased handlers. TLS reads and writes one buffer at a time.
class PlainStream {
 public:
  using executor_type = Executor;
  using lowest_layer_type = Socket;

  explicit PlainStream(boost::asio::io_context& io) : tcp_(io) {}
  explicit PlainStream(Socket socket) : tcp_(std::move(socket)) {}

  TcpStream& tcp() { return tcp_; }
  executor_type get_executor() { return tcp_.get_executor(); }
  lowest_layer_type& lowest_layer() { return tcp_.socket(); }

  // These functions read or write some bytes, at least one, and call `then`.
  void ReadSome(boost::asio::mutable_buffer into, Completion then);
  void WriteSome(const Parts& parts, Completion then);

  // Implements the concepts AsyncReadStream and AsyncWriteStream of Boost.Asio.
  template <typename Handler>
  void async_read_some(boost::asio::mutable_buffer into, Handler&& handler) {
    ReadSome(into, Completion(std::forward<Handler>(handler)));
  }
  template <typename Handler>
  void async_write_some(boost::asio::const_buffer part, Handler&& handler) {
    WriteSome(Parts(1, part), Completion(std::forward<Handler>(handler)));
  }

 private:
  TcpStream tcp_;
};

// A connection with or without TLS.
class ByteStream {
 public:
  using executor_type = Executor;
  using error_code = boost::system::error_code;
  using Tls = boost::asio::ssl::stream<PlainStream>;

  // Creates a stream that is not connected yet.
  explicit ByteStream(boost::asio::io_context& io) : plain_(std::in_place, io) {}
  explicit ByteStream(Socket socket) : plain_(std::in_place, std::move(socket)) {}

  // Returns the TCP stream below TLS, to limit and close it.
  TcpStream& tcp() { return tls_ ? tls_->stream.next_layer().tcp() : plain_->tcp(); }
  executor_type get_executor() { return tcp().get_executor(); }

  // Enables TLS. Call Handshake() afterwards. `context` must outlive the stream.
  Tls& StartTls(boost::asio::ssl::context& context);
  // Call StartTls() first. `already_read` has bytes that were read from the connection before.
  // `then` gets the number of these bytes that the handshake used.
  void Handshake(boost::asio::ssl::stream_base::handshake_type type,
                 boost::asio::const_buffer already_read, Completion then);
  // Shuts TLS down. Without TLS, only calls `then`.
  void Shutdown(Completion then);

  // These functions read or write some bytes, at least one, and call `then`.
  void ReadSome(boost::asio::mutable_buffer into, Completion then);
  void WriteSome(const Parts& parts, Completion then);
  // Writes all bytes, and calls `then` with their number. The stream must not be moved meanwhile.
  void Write(const Parts& parts, Completion then);
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
  // A record of TLS has at most this many bytes (RFC 8446, section 5.1).
  static constexpr std::size_t kTlsRecordBytes = 16u << 10;
  struct TlsLayer {
    TlsLayer(PlainStream plain, boost::asio::ssl::context& context)
        : stream(std::move(plain), context) {}
    Tls stream;
    std::array<char, kTlsRecordBytes> record{};  // small parts that are encrypted together
  };

  // Writes all parts. `written` is the number of bytes that were written before them.
  void WriteRest(const Parts& parts, std::size_t written, Completion then);

  // Returns the first buffer that is not empty.
  template <typename Buffers>
  static boost::asio::mutable_buffer FirstOf(const Buffers& buffers) {
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto part = boost::asio::buffer_sequence_begin(buffers); part != end; ++part) {
      const boost::asio::mutable_buffer buffer = *part;
      if (buffer.size() > 0) return buffer;
    }
    return {};
  }
  // Returns the buffers that are not empty, at most as many as Parts can have.
  template <typename Buffers>
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

  std::optional<PlainStream> plain_;  // until StartTls()
  std::unique_ptr<TlsLayer> tls_;     // since StartTls(); null for plain TCP
};

}  // namespace gsv::gateway::transport
