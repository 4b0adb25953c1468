// A connection to another instance, by TLS where its address is an https one: a stream of bytes as
// Boost.Beast wants it (AsyncStream), so that HTTP and WebSocket go over either alike.
//
// Threads  that which runs the executor.
#pragma once

#include <string>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

class Transport {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;
  using error_code = boost::system::error_code;

  // Not connected yet. `address` outlives it.
  Transport(boost::asio::io_context& io, const Address& address);

  // Below TLS: to connect it, to limit its time, to close it.
  boost::beast::tcp_stream& tcp() { return stream_.next_layer(); }
  executor_type get_executor() { return stream_.get_executor(); }

  // Once it is connected; then(error_code). The certificate must be good and the address's.
  template <typename Then>
  void AsyncSecure(Then then) {
    if (!is_secure_) return boost::asio::post(get_executor(), [then] { then(error_code()); });
    stream_.async_handshake(boost::asio::ssl::stream_base::client, std::move(then));
  }

  template <typename Buffers, typename Token>
  BOOST_ASIO_INITFN_RESULT_TYPE(Token, void(error_code, std::size_t))
  async_read_some(const Buffers& buffers, Token&& token) {
    return is_secure_ ? stream_.async_read_some(buffers, std::forward<Token>(token))
                      : tcp().async_read_some(buffers, std::forward<Token>(token));
  }
  template <typename Buffers, typename Token>
  BOOST_ASIO_INITFN_RESULT_TYPE(Token, void(error_code, std::size_t))
  async_write_some(const Buffers& buffers, Token&& token) {
    return is_secure_ ? stream_.async_write_some(buffers, std::forward<Token>(token))
                      : tcp().async_write_some(buffers, std::forward<Token>(token));
  }

  // How Boost.Beast ends a WebSocket, at once and in order.
  friend void beast_close_socket(Transport& transport) { transport.tcp().close(); }
  template <typename Handler>
  friend void async_teardown(boost::beast::role_type role, Transport& transport,
                             Handler&& handler) {
    using boost::beast::websocket::async_teardown;
    if (transport.is_secure_) {
      async_teardown(role, transport.stream_, std::forward<Handler>(handler));
    } else {
      async_teardown(role, transport.tcp(), std::forward<Handler>(handler));
    }
  }

 private:
  const bool is_secure_;
  boost::beast::ssl_stream<boost::beast::tcp_stream> stream_;
};

// Why there is no connection, and what to do about it.
std::string WhyNotConnected(const boost::system::error_code& error);
inline constexpr char kIsItThere[] = "is gsv running there, and is the address right?";

}  // namespace gsv::gateway::upstream
