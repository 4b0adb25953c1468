#include "gsv/gateway/testing/web_client.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace gsv::gateway::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

tcp::endpoint Endpoint(std::uint16_t port) { return {asio::ip::address_v4::loopback(), port}; }

std::string HostOf(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

}  // namespace

struct HttpConnection::Impl {
  asio::io_context io;
  tcp::socket socket{io};
  beast::flat_buffer buffer;
};

HttpConnection::HttpConnection(std::uint16_t port) : impl_(std::make_unique<Impl>()) {
  impl_->socket.connect(Endpoint(port));
}

HttpConnection::~HttpConnection() = default;

void HttpConnection::Send(const std::string& bytes) {
  error_code ignored;  // the server may close the connection; its answer has the reason
  asio::write(impl_->socket, asio::buffer(bytes), ignored);
}

std::optional<HttpReply> HttpConnection::Receive(bool has_body) {
  http::response_parser<http::string_body> parser;
  parser.body_limit(std::uint64_t{1} << 30);
  parser.skip(!has_body);
  error_code error;
  http::read(impl_->socket, impl_->buffer, parser, error);
  if (error) return std::nullopt;
  HttpReply reply;
  reply.status = static_cast<int>(parser.get().result_int());
  for (const auto& field : parser.get()) {
    std::string name(field.name_string());
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    reply.headers[name] = std::string(field.value());
  }
  reply.body = parser.get().body();
  return reply;
}

bool HttpConnection::IsClosed() {
  char byte = 0;
  error_code error;
  impl_->socket.read_some(asio::buffer(&byte, 1), error);
  return error == asio::error::eof || error == asio::error::connection_reset;
}

std::string RequestText(std::uint16_t port, const std::string& method, const std::string& target,
                        const std::string& more_headers, const std::string& body) {
  const bool has_host = more_headers.find("Host:") != std::string::npos;
  return method + " " + target + " HTTP/1.1\r\n" +
         (has_host ? "" : "Host: " + HostOf(port) + "\r\n") + more_headers +
         (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" +
         body;
}

HttpReply Fetch(std::uint16_t port, const std::string& method, const std::string& target,
                const std::string& more_headers, const std::string& body) {
  HttpConnection connection(port);
  connection.Send(RequestText(port, method, target, more_headers, body));
  std::optional<HttpReply> reply = connection.Receive(method != "HEAD");
  if (!reply) throw std::runtime_error("no answer to " + method + " " + target);
  return *reply;
}

struct Viewer::Impl {
  asio::io_context io;
  websocket::stream<tcp::socket> stream{io};
  beast::flat_buffer buffer;
  std::string subprotocol;
};

Viewer::Viewer(std::uint16_t port, const std::string& target, const std::string& subprotocols,
               const std::string& origin)
    : impl_(std::make_unique<Impl>()) {
  impl_->stream.next_layer().connect(Endpoint(port));
  impl_->stream.read_message_max(0);
  impl_->stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    if (!subprotocols.empty()) request.set(http::field::sec_websocket_protocol, subprotocols);
    if (!origin.empty()) request.set(http::field::origin, origin);
  }));
  websocket::response_type response;
  error_code error;
  impl_->stream.handshake(response, HostOf(port), target, error);
  if (error) {
    throw std::runtime_error(std::to_string(response.result_int()) + " " + response.body());
  }
  impl_->subprotocol = std::string(response[http::field::sec_websocket_protocol]);
}

Viewer::~Viewer() = default;

const std::string& Viewer::subprotocol() const { return impl_->subprotocol; }

void Viewer::SendText(const std::string& text) {
  impl_->stream.text(true);
  impl_->stream.write(asio::buffer(text));
}

void Viewer::SendBinary(const std::string& bytes) {
  impl_->stream.binary(true);
  impl_->stream.write(asio::buffer(bytes));
}

void Viewer::SendRaw(const std::string& bytes) {
  error_code ignored;  // the server may close the connection during the call
  asio::write(impl_->stream.next_layer(), asio::buffer(bytes), ignored);
}

std::optional<Viewer::Frame> Viewer::Receive() {
  impl_->buffer.clear();
  error_code error;
  impl_->stream.read(impl_->buffer, error);
  if (error) return std::nullopt;
  return Frame{impl_->stream.got_text(), beast::buffers_to_string(impl_->buffer.cdata())};
}

nlohmann::json Viewer::ReceiveText(const std::string& op) {
  while (const std::optional<Frame> frame = Receive()) {
    if (!frame->is_text) {
      Keep(*frame);
    } else if (frame->json()["op"] == op) {
      return frame->json();
    }
  }
  throw std::runtime_error("the connection ended before a text message with op '" + op + "'");
}

std::string Viewer::ReceiveBytes(char opcode) {
  while (const std::optional<Frame> frame = Receive()) {
    if (frame->is_text) continue;
    if (frame->bytes.front() == opcode) return frame->bytes;
    Keep(*frame);
  }
  throw std::runtime_error("the connection ended before an answer");
}

void Viewer::SendCall(const std::string& name, const std::string& request) {
  if (services_.empty()) {
    const nlohmann::json advertised = ReceiveText("advertiseServices");
    for (const auto& service : advertised["services"]) services_[service["name"]] = service["id"];
  }
  const auto number = [](std::uint32_t value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  SendBinary("\x02" + number(services_.at("/gsv/" + name)) + number(1) + number(3) + "cdr" +
             request);
}

std::string Viewer::CallRefusedService(const std::string& name) {
  SendCall(name, "");
  return ReceiveText("serviceCallFailure")["message"];
}

std::pair<bool, std::string> Viewer::CallService(const std::string& name,
                                                 const std::string& request) {
  SendCall(name, request);
  const std::string response = ReceiveBytes(3).substr(1 + 4 + 4 + 4 + 3);
  messages::CdrReader reader(std::as_bytes(std::span(response)));
  std::pair<bool, std::string> outcome;
  reader.Read(outcome.first);
  reader.Read(outcome.second);
  if (!reader.Finish()) throw std::runtime_error("the response is no CDR");
  return outcome;
}

ReceivedData Viewer::ReceiveData(foxglove::SubscriptionId subscription) {
  std::deque<ReceivedData>& kept = kept_[subscription];
  while (kept.empty()) {
    const std::optional<Frame> frame = Receive();
    if (!frame) throw std::runtime_error("the connection ended before data");
    if (!frame->is_text) Keep(*frame);
  }
  ReceivedData data = std::move(kept.front());
  kept.pop_front();
  return data;
}

void Viewer::Keep(const Frame& frame) {
  ReceivedData data = frame.data();
  if (data.opcode == 1) kept_[data.subscription].push_back(std::move(data));
}

void Viewer::Subscribe(foxglove::SubscriptionId id, const std::string& topic) {
  while (!channels_.contains(topic)) {
    const nlohmann::json advertisement = ReceiveText("advertise");
    for (const auto& channel : advertisement["channels"]) {
      channels_[channel["topic"]] = channel["id"];
    }
  }
  SendText(SubscribeText(id, channels_[topic]));
}

std::uint16_t Viewer::close_code() const { return impl_->stream.reason().code; }

std::string Viewer::close_reason() const {
  return std::string(impl_->stream.reason().reason.c_str());
}

void Viewer::Close() {
  error_code ignored;
  impl_->stream.close(websocket::close_code::normal, ignored);
}

}  // namespace gsv::gateway::testing
