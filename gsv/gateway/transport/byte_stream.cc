#include "gsv/gateway/transport/byte_stream.h"

#include <boost/asio/post.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace gsv::gateway::transport {

namespace asio = boost::asio;
namespace beast = boost::beast;

ByteStream::Tls& ByteStream::StartTls(asio::ssl::context& context) {
  tls_ = std::make_unique<Tls>(*std::move(plain_), context);
  plain_.reset();
  return *tls_;
}

void ByteStream::Handshake(asio::ssl::stream_base::handshake_type type,
                           asio::const_buffer already_read, Completion then) {
  tls_->async_handshake(type, already_read, std::move(then));
}

void ByteStream::Shutdown(Completion then) {
  if (tls_) return tls_->async_shutdown(std::move(then));
  asio::post(get_executor(), [then = std::move(then)]() mutable { then({}); });
}

void ByteStream::ReadSome(asio::mutable_buffer into, Completion then) {
  tls_ ? tls_->async_read_some(into, std::move(then))
       : plain_->async_read_some(into, std::move(then));
}

void ByteStream::WriteSome(const Parts& parts, Completion then) {
  tls_ ? tls_->async_write_some(parts, std::move(then))
       : plain_->async_write_some(parts, std::move(then));
}

void ByteStream::Teardown(beast::role_type role, Completion then) {
  using beast::websocket::async_teardown;
  tls_ ? async_teardown(role, *tls_, std::move(then))
       : async_teardown(role, *plain_, std::move(then));
}

}  // namespace gsv::gateway::transport
