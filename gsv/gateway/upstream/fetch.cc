#include "gsv/gateway/upstream/fetch.h"

#include <optional>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include "gsv/gateway/upstream/secure.h"

namespace gsv::gateway::upstream {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::asio::ip::tcp;
using boost::system::error_code;

// Maximum size of a response. A model with all its textures is far smaller.
constexpr std::uint64_t kMaxBodyBytes = std::uint64_t{512} << 20;

// One request and its response. Each step of the exchange starts the next step.
class Exchange {
 public:
  Exchange(const Address& address, const Request& request) : address_(address) {
    message_.method_string(request.method);
    message_.target(request.raw_target);
    message_.version(11);
    message_.set(http::field::host, address.Authority());
    message_.set(http::field::user_agent, "gsv");
    if (!request.content_type.empty()) {
      message_.set(http::field::content_type, request.content_type);
    }
    if (!request.if_none_match.empty()) {
      message_.set(http::field::if_none_match, request.if_none_match);
    }
    if (!address.token.empty()) {
      message_.set(http::field::authorization, "Bearer " + address.token);
    }
    if (!request.viewer.empty()) message_.set("Gsv-Viewer", request.viewer);
    message_.keep_alive(false);
    message_.body() = request.body;
    message_.prepare_payload();
    parser_.body_limit(kMaxBodyBytes);
  }

  base::Result<Response> Run(std::chrono::milliseconds limit) {
    resolver_.async_resolve(address_.host, address_.port,
                            [this](error_code error, tcp::resolver::results_type results) {
                              if (!Failed(error)) Connect(results);
                            });
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

  void Connect(const tcp::resolver::results_type& results) {
    stream_.tcp().async_connect(results, [this](error_code error, const tcp::endpoint&) {
      if (!Failed(error)) BeginTls();
    });
  }

  void BeginTls() {
    StartTls(stream_, address_, transport::Completion([this](error_code error) {
               if (!Failed(error)) Write();
             }));
  }

  void Write() {
    http::async_write(stream_, message_, [this](error_code error, std::size_t) {
      if (!Failed(error)) Read();
    });
  }

  void Read() {
    http::async_read(stream_, buffer_, parser_,
                     [this](error_code error, std::size_t) { is_done_ = !Failed(error); });
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
  http::request<http::string_body> message_;
  http::response_parser<http::string_body> parser_;
  beast::flat_buffer buffer_;
  boost::asio::io_context io_;
  tcp::resolver resolver_{io_};
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
