#include "gsv/gateway/upstream/fetch.h"

#include <optional>

#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/string_body.hpp>

#include "gsv/gateway/transport/connector.h"
#include "gsv/gateway/transport/http_message.h"
#include "gsv/gateway/upstream/secure.h"

namespace gsv::gateway::upstream {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using transport::Completion;

// Maximum size of a response. A model with all its textures is far smaller.
constexpr std::uint64_t kMaxBodyBytes = std::uint64_t{512} << 20;

// One request and its response. Each step of the exchange starts the next step.
class Exchange {
 public:
  Exchange(const Address& address, const Request& request)
      : address_(address), body_(request.body) {
    http::request<http::span_body<const char>> message;
    message.method_string(request.method);
    message.target(request.raw_target);
    message.version(11);
    message.set(http::field::host, address.Authority());
    message.set(http::field::user_agent, "gsv");
    if (!request.content_type.empty()) {
      message.set(http::field::content_type, request.content_type);
    }
    if (!request.if_none_match.empty()) {
      message.set(http::field::if_none_match, request.if_none_match);
    }
    if (!address.token.empty()) {
      message.set(http::field::authorization, "Bearer " + address.token);
    }
    if (!request.viewer.empty()) message.set("Gsv-Viewer", request.viewer);
    message.keep_alive(false);
    message.body() = {body_.data(), body_.size()};
    message.prepare_payload();
    header_ = transport::HeaderText(message.base());
    parser_.body_limit(kMaxBodyBytes);
  }

  base::Result<Response> Run(std::chrono::milliseconds limit) {
    connector_.Connect(stream_, address_.host, address_.port, limit,
                       Completion([this](error_code error) {
                         if (!Failed(error)) BeginTls();
                       }));
    io_.run_for(limit);
    if (is_done_) return Answer();
    if (error_) {
      return base::Fail(base::ErrorCode::kUnavailable, "no answer: " + WhyNotConnected(error_),
                        address_.Url());
    }
    return base::Fail(
        base::ErrorCode::kTimeout,
        "no answer within " + std::to_string(limit.count()) + " ms; " + kConnectionHint,
        address_.Url());
  }

 private:
  bool Failed(error_code error) {
    error_ = error;
    return static_cast<bool>(error);
  }

  void BeginTls() {
    StartTls(stream_, address_, Completion([this](error_code error) {
               if (!Failed(error)) Write();
             }));
  }

  void Write() {
    stream_.Write({boost::asio::buffer(header_), boost::asio::buffer(body_)},
                  Completion([this](error_code error) {
                    if (!Failed(error)) Read();
                  }));
  }

  void Read() {
    transport::ReadMessage(stream_, buffer_, parser_,
                           Completion([this](error_code error) { is_done_ = !Failed(error); }));
  }

  Response Answer() {
    auto& message = parser_.get();
    const auto text = [&](http::field field) {
      const beast::string_view value = message[field];
      return std::string(value.data(), value.size());
    };
    Response response;
    response.status = static_cast<int>(message.result_int());
    response.content_type = text(http::field::content_type);
    response.etag = text(http::field::etag);
    if (const auto time = message.find("Gsv-Time"); time != message.end()) {
      response.headers.emplace_back("Gsv-Time", std::string(time->value()));
    }
    response.cache_control = text(http::field::cache_control);
    response.allow = text(http::field::allow);
    response.body = SharedBytes(std::move(message.body()));
    return response;
  }

  const Address& address_;
  std::string header_;
  const std::string& body_;
  http::response_parser<http::string_body> parser_;
  beast::flat_buffer buffer_;
  boost::asio::io_context io_;
  transport::Connector connector_{io_};
  transport::ByteStream stream_{io_};
  error_code error_;
  bool is_done_ = false;
};

}  // namespace

base::Result<Response> Fetch(const Address& address, const Request& request,
                             std::chrono::milliseconds limit) {
  return Exchange(address, request).Run(limit);
}

}  // namespace gsv::gateway::upstream
