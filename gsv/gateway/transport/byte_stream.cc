#include "gsv/gateway/transport/byte_stream.h"

#include <boost/beast/websocket/teardown.hpp>

namespace gsv::gateway::transport {

namespace asio = boost::asio;
namespace beast = boost::beast;

namespace {

// Returns the parts without their first `count` bytes.
Parts Without(std::size_t count, const Parts& parts) {
  Parts rest;
  for (const asio::const_buffer& part : parts) {
    const asio::const_buffer remaining = part + count;
    count -= part.size() - remaining.size();
    if (remaining.size() > 0) rest.push_back(remaining);
  }
  return rest;
}

}  // namespace

void PlainStream::ReadSome(asio::mutable_buffer into, Completion then) {
  tcp_.async_read_some(into, std::move(then));
}

void PlainStream::WriteSome(const Parts& parts, Completion then) {
  tcp_.async_write_some(parts, std::move(then));
}

ByteStream::Tls& ByteStream::StartTls(asio::ssl::context& context) {
  tls_ = std::make_unique<TlsLayer>(*std::move(plain_), context);
  plain_.reset();
  return tls_->stream;
}

void ByteStream::Handshake(asio::ssl::stream_base::handshake_type type,
                           asio::const_buffer already_read, Completion then) {
  tls_->stream.async_handshake(type, already_read, std::move(then));
}

void ByteStream::Shutdown(Completion then) {
  tls_ ? tls_->stream.async_shutdown(std::move(then)) : Post(get_executor(), std::move(then));
}

void ByteStream::ReadSome(asio::mutable_buffer into, Completion then) {
  tls_ ? tls_->stream.async_read_some(into, std::move(then))
       : plain_->ReadSome(into, std::move(then));
}

void ByteStream::WriteSome(const Parts& parts, Completion then) {
  if (!tls_) return plain_->WriteSome(parts, std::move(then));
  // TLS makes a record of each buffer. So the small parts at the beginning are written as one.
  asio::const_buffer first = parts.empty() ? asio::const_buffer() : parts.front();
  if (parts.size() > 1 && first.size() < kTlsRecordBytes) {
    const auto record = asio::buffer(tls_->record);
    first = asio::buffer(record, asio::buffer_copy(record, parts));
  }
  tls_->stream.async_write_some(first, std::move(then));
}

void ByteStream::Write(const Parts& parts, Completion then) {
  WriteRest(parts, 0, std::move(then));
}

void ByteStream::WriteRest(const Parts& parts, std::size_t written, Completion then) {
  WriteSome(parts, Completion([this, parts, written, then = std::move(then)](
                                  error_code error, std::size_t bytes) mutable {
              const auto rest = Without(bytes, parts);
              if (error || rest.empty()) return then(error, written + bytes);
              WriteRest(rest, written + bytes, std::move(then));
            }));
}

void ByteStream::Teardown(beast::role_type role, Completion then) {
  using beast::websocket::async_teardown;
  tls_ ? tls_->stream.async_shutdown(std::move(then))
       : async_teardown(role, plain_->tcp(), std::move(then));
}

}  // namespace gsv::gateway::transport
