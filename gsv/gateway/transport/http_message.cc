#include "gsv/gateway/transport/http_message.h"

#include <utility>

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/read_size.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/serializer.hpp>

namespace gsv::gateway::transport {
namespace {

namespace http = boost::beast::http;
using boost::beast::flat_buffer;
using boost::system::error_code;

// Maximum number of bytes that one read takes from the stream.
constexpr std::size_t kReadSize = 64u << 10;

// A message that is being read.
template <bool is_request>
struct Reading {
  ByteStream& stream;
  flat_buffer& buffer;
  http::basic_parser<is_request>& parser;
  Completion then;

  // If not eager, the parser stops after the header.
  bool is_done() const { return parser.eager() ? parser.is_done() : parser.is_header_done(); }
};

// Gives the buffer to the parser. Returns need_more if the parser needs more bytes.
template <bool is_request>
error_code Parse(Reading<is_request>& reading) {
  while (!reading.is_done()) {
    if (reading.buffer.size() == 0) return http::error::need_more;
    error_code error;
    reading.buffer.consume(reading.parser.put(reading.buffer.data(), error));
    if (error) return error;
  }
  return {};
}

// Handles the end of the connection. The body of a response may end with it.
template <bool is_request>
error_code ParseEnd(Reading<is_request>& reading) {
  if (!reading.parser.got_some()) return http::error::end_of_stream;
  error_code error;
  reading.parser.put_eof(error);
  return error;
}

template <bool is_request>
void ReadMore(Reading<is_request> reading) {
  ByteStream& stream = reading.stream;
  const auto into = reading.buffer.prepare(boost::beast::read_size(reading.buffer, kReadSize));
  stream.ReadSome(
      into, Completion([reading = std::move(reading)](error_code error, std::size_t bytes) mutable {
        reading.buffer.commit(bytes);
        if (error == boost::asio::error::eof) {
          error = ParseEnd(reading);
        } else if (!error) {
          error = Parse(reading);
          if (error == http::error::need_more) return ReadMore(std::move(reading));
        }
        reading.then(error, bytes);
      }));
}

template <bool is_request>
void Begin(Reading<is_request> reading) {
  const error_code error = Parse(reading);
  if (error == http::error::need_more) return ReadMore(std::move(reading));
  const Executor executor = reading.stream.get_executor();
  Post(executor, Completion([then = std::move(reading.then), error]() mutable { then(error); }));
}

}  // namespace

template <bool is_request>
void ReadHeader(ByteStream& stream, flat_buffer& buffer, http::basic_parser<is_request>& parser,
                Completion then) {
  parser.eager(false);
  Begin(Reading<is_request>{stream, buffer, parser, std::move(then)});
}

template <bool is_request>
void ReadMessage(ByteStream& stream, flat_buffer& buffer, http::basic_parser<is_request>& parser,
                 Completion then) {
  parser.eager(true);
  Begin(Reading<is_request>{stream, buffer, parser, std::move(then)});
}

std::string HeaderText(const http::request_header<>& header) {
  http::fields::writer writer(header, header.version(), header.method());
  return boost::beast::buffers_to_string(writer.get());
}

std::string HeaderText(const http::response_header<>& header) {
  http::fields::writer writer(header, header.version(), header.result_int());
  return boost::beast::buffers_to_string(writer.get());
}

template void ReadHeader(ByteStream&, flat_buffer&, http::basic_parser<true>&, Completion);
template void ReadMessage(ByteStream&, flat_buffer&, http::basic_parser<true>&, Completion);
template void ReadMessage(ByteStream&, flat_buffer&, http::basic_parser<false>&, Completion);

}  // namespace gsv::gateway::transport
