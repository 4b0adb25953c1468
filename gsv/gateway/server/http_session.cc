#include "gsv/gateway/server/http_session.h"

#include <limits>
#include <optional>
#include <utility>

#include <boost/asio/dispatch.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "gsv/base/log.h"
#include "gsv/gateway/server/websocket_session.h"
#include "gsv/gateway/transport/byte_stream.h"
#include "gsv/gateway/transport/http_message.h"

namespace gsv::gateway {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using transport::ByteStream;
using transport::Completion;
using EmptyResponse = http::response<http::empty_body>;

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

std::string Text(const http::request<http::string_body>& request, http::field field) {
  return std::string(View(request[field]));
}

// Returns the response to bytes that are not an acceptable request, or nullopt if the connection
// was closed.
std::optional<Response> ResponseTo(error_code error, std::uint64_t header_limit,
                                   std::uint64_t body_limit) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return ErrorResponse(
        431, "the header of the request is longer than " + std::to_string(header_limit) + " bytes");
  }
  if (error == http::error::body_limit) {
    return ErrorResponse(
        413, "the body of the request is longer than " + std::to_string(body_limit) + " bytes");
  }
  if (error.category() == make_error_code(http::error::bad_target).category() &&
      error != http::error::end_of_stream && error != http::error::partial_message) {
    return ErrorResponse(400, "this is not an HTTP request: " + error.message());
  }
  return std::nullopt;
}

// Time limit for receiving one file.
constexpr std::chrono::minutes kUploadTime{5};

// Time limit for a client to begin TLS, and to close the connection.
constexpr std::chrono::seconds kLeaveTime{1};
// The first byte of a connection with TLS: the record type of a handshake (RFC 8446, section 5.1).
constexpr unsigned char kTlsHandshake = 22;
// Maximum number of bytes that are read to detect TLS.
constexpr std::size_t kFirstRead = 1536;
// Time limit for a handshake, unless the limit of a request is shorter.
constexpr std::chrono::milliseconds kHandshakeTime{10'000};

std::string PathOf(const Target& target) {
  std::string path;
  for (const std::string& segment : target.segments) path += "/" + segment;
  return path.empty() ? "/" : path;
}

using KeepTrack = std::function<void(std::weak_ptr<Connection>)>;

class HttpSession final : public Connection, public std::enable_shared_from_this<HttpSession> {
 public:
  // `buffer` has the bytes that were read from `stream` already.
  HttpSession(ByteStream stream, beast::flat_buffer buffer, std::shared_ptr<ServerContext> context,
              std::unique_ptr<ConnectionSlot> slot, KeepTrack keep_track)
      : stream_(std::move(stream)),
        buffer_(std::move(buffer)),
        context_(std::move(context)),
        slot_(std::move(slot)),
        keep_track_(std::move(keep_track)) {}

  void BeginTls() {
    stream_.StartTls(*context_->tls);
    tcp().expires_after(std::min(kHandshakeTime, limits().request_time));
    is_idle_ = true;
    stream_.Handshake(boost::asio::ssl::stream_base::server, buffer_.data(),
                      Completion([self = shared_from_this()](error_code error, std::size_t used) {
                        self->is_idle_ = false;
                        if (error) return self->tcp().close();
                        self->buffer_.consume(used);
                        self->Read();
                      }));
  }

  void Read() {
    is_head_ = false;
    parser_.emplace();
    parser_->header_limit(limits().header_bytes);
    // OnHeader() sets the limit later. The maximum means "no limit", because Boost 1.74 treats
    // boost::none as 0.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    tcp().expires_after(limits().request_time);
    is_idle_ = true;
    transport::ReadHeader(stream_, buffer_, *parser_,
                          Completion([self = shared_from_this()](error_code error) {
                            self->is_idle_ = false;
                            self->OnHeader(error);
                          }));
  }

  void Shutdown() override {
    if (is_idle_) tcp().close();
  }

  void Cut() override { tcp().close(); }

 private:
  transport::TcpStream& tcp() { return stream_.tcp(); }
  const ServerLimits& limits() const { return context_->options.limits; }

  // Called before the body is read. Refuses a body that is too long, and a file if the client has
  // no permission to send it.
  void OnHeader(error_code error) {
    if (error) return RespondToError(error);
    const auto& request = parser_->get();
    version_ = request.version();
    is_head_ = request.method() == http::verb::head;
    keep_alive_ = false;  // if an answer is sent before the whole request was read, the connection
                          // is closed
    principal_.reset();
    target_ = ParseTarget(View(request.target()));
    match_ = target_ ? context_->handler.router().Find(Method(), *target_) : Router::Match();
    const bool takes_file = match_.route != nullptr && match_.route->takes_file;
    body_limit_ = takes_file ? limits().upload_bytes : limits().body_bytes;
    if (parser_->content_length().value_or(0) > body_limit_) {
      return RespondToError(make_error_code(http::error::body_limit));
    }
    parser_->body_limit(body_limit_);
    takes_file ? Authorise([](HttpSession& self) { self.ReadFile(); }) : ReadBody();
  }

  void ReadFile() {
    upload_ = UploadSlot::Take(context_);
    if (!upload_) {
      return Write(ErrorResponse(503, "too many uploads at the same time; try again in a moment"));
    }
    tcp().expires_after(kUploadTime);
    ReadBody();
  }

  void ReadBody() {
    transport::ReadMessage(
        stream_, buffer_, *parser_,
        Completion([self = shared_from_this()](error_code failed) { self->OnRead(failed); }));
  }

  void RespondToError(error_code error) {
    std::optional<Response> complaint = ResponseTo(error, limits().header_bytes, body_limit_);
    if (!complaint) return;
    keep_alive_ = false;
    Write(std::move(*complaint));
  }

  void OnRead(error_code error) {
    if (error) return RespondToError(error);
    const auto& request = parser_->get();
    keep_alive_ = request.keep_alive();
    const base::Status allowed = context_->access.Check(View(request[http::field::host]),
                                                        View(request[http::field::origin]));
    if (!allowed) {
      spdlog::info("refused a request: {}", allowed.error().Sentence());
      return Write(ErrorResponse(403, allowed.error().Sentence()));
    }
    if (!target_) return Write(ErrorResponse(target_.error()));
    Authorise([](HttpSession& self) { self.Dispatch(); });
  }

  std::string_view Method() const {
    return is_head_ ? std::string_view("GET") : View(parser_->get().method_string());
  }

  // Returns a query parameter if the request is for a WebSocket or an image, because a page cannot
  // set headers of these requests. For other requests, returns an empty text.
  std::string SocketQuery(const std::string& name) const {
    const bool is_read = match_.route != nullptr && (match_.route->find_hub != nullptr ||
                                                     match_.route->accepts_token_in_query);
    const auto found = target_->query.find(name);
    return is_read && found != target_->query.end() ? found->second : std::string();
  }

  std::string ViewerKey() const {
    const std::string key(View(parser_->get()["Gsv-Viewer"]));
    return key.empty() ? SocketQuery("viewer") : key;
  }

  using Next = void (*)(HttpSession&);

  // Calls `next`, now or later on this session's thread, if the client has the permission that the
  // request needs; otherwise sends the reason.
  void Authorise(Next next) {
    if (match_.permission == Permission::kNone) return next(*this);
    if (principal_) return Permit(next);
    const std::string authorization = Text(parser_->get(), http::field::authorization);
    access::Credentials credentials{std::string(access::BearerToken(authorization))};
    if (credentials.token.empty()) credentials.token = SocketQuery("token");
    tcp().expires_never();  // the authenticator has its own time limit
    context_->authenticator->Authenticate(
        credentials, [self = shared_from_this(), next](const access::Principal& principal) {
          boost::asio::dispatch(self->stream_.get_executor(), [self, next, principal] {
            self->principal_ = principal;
            self->Permit(next);
          });
        });
  }

  void Permit(Next next) {
    tcp().expires_after(limits().request_time);
    const access::Principal& principal = *principal_;
    if (principal.permission < match_.permission) {
      const std::string why = context_->authenticator->Refusal(principal, match_.permission);
      // Log only the path, because the query may contain a token.
      spdlog::info("refused {} {}: {}", View(parser_->get().method_string()), PathOf(*target_),
                   why);
      return Write(ErrorResponse(principal.showed_credentials ? 403 : 401, why));
    }
    const Route* const route = match_.route;
    if (route != nullptr && route->needs_control && route->find_hub == nullptr) {
      const base::Status free =
          context_->handler.CheckControl(ViewerKey(), match_.parameters.at("name"));
      if (!free) return Write(ErrorResponse(free.error()));
    }
    next(*this);
  }

  void Dispatch() {
    const bool is_upgrade = beast::websocket::is_upgrade(parser_->get());
    if (is_upgrade && (match_.route == nullptr || match_.route->find_hub == nullptr)) {
      return Write(ErrorResponse(404, "WebSockets are served at /ws"));
    }
    if (match_.route == nullptr) return Write(NoRoute(match_));
    if (is_upgrade) return Upgrade();
    upload_.reset();
    tcp().expires_never();  // handlers have their own time limits
    context_->handler.Handle(
        *match_.route, TakeRequest(), [self = shared_from_this()](Response response) mutable {
          auto executor = self->stream_.get_executor();
          transport::Post(executor, Completion([self = std::move(self),
                                                answer = std::move(response)]() mutable {
                            self->Write(std::move(answer));
                          }));
        });
  }

  Request TakeRequest() {
    auto& message = parser_->get();
    Request request;
    request.method = std::string(Method());
    request.raw_target = std::string(View(message.target()));
    request.target = *std::move(target_);
    request.body = std::move(message.body());
    request.content_type = Text(message, http::field::content_type);
    request.if_none_match = Text(message, http::field::if_none_match);
    request.viewer = std::string(View(message["Gsv-Viewer"]));
    request.parameters = std::move(match_.parameters);
    return request;
  }

  void Upgrade() {
    const std::string offered = Text(parser_->get(), http::field::sec_websocket_protocol);
    const std::string_view subprotocol = foxglove::ChooseSubprotocol(offered);
    if (subprotocol.empty()) {
      return Write(ErrorResponse(400,
                                 "a WebSocket must offer the sub-protocol foxglove.sdk.v1 or "
                                 "foxglove.websocket.v1"));
    }
    SocketOwner owner{principal_.value_or(access::Principal()), ViewerKey(),
                      !match_.route->needs_control};
    base::Result<std::shared_ptr<Hub>> hub = match_.route->find_hub(TakeRequest());
    if (!hub) return Write(ErrorResponse(hub.error()));
    tcp().expires_never();
    keep_track_(StartWebSocketSession(std::move(stream_), parser_->release(), subprotocol,
                                      std::move(*hub), context_, std::move(slot_),
                                      std::move(owner)));
  }

  void Write(Response response) {
    ++context_->traffic->answers.at(static_cast<std::size_t>(response.status / 100));
    keep_alive_ = keep_alive_ && !context_->stopping && !response.stream;
    if (response.stream && !is_head_) return WriteStream(response);
    const bool has_length = response.status != 304 && response.status != 204 && !response.stream;
    EmptyResponse header = Header(response);
    if (has_length) header.content_length(response.body.size());
    Send(header, is_head_ || !has_length ? SharedBytes() : std::move(response.body));
  }

  EmptyResponse Header(const Response& response) const {
    EmptyResponse message{static_cast<http::status>(response.status), version_};
    const auto set = [&](http::field field, const std::string& value) {
      if (!value.empty()) message.set(field, value);
    };
    message.set(http::field::server, "gsv");
    set(http::field::content_type, response.content_type);
    set(http::field::etag, response.etag);
    set(http::field::cache_control, response.cache_control);
    set(http::field::allow, response.allow);
    message.set("X-Content-Type-Options", "nosniff");
    message.set("Content-Security-Policy",
                response.allows_own_frames ? "frame-ancestors 'self'" : "frame-ancestors 'none'");
    message.set("Cross-Origin-Resource-Policy",
                response.allows_other_sites ? "cross-origin" : "same-origin");
    for (const auto& [name, value] : response.headers) message.set(name, value);
    message.keep_alive(keep_alive_);
    return message;
  }

  void Send(const EmptyResponse& header, SharedBytes body) {
    tcp().expires_after(limits().request_time);
    header_ = transport::HeaderText(header.base());
    const transport::Parts parts{boost::asio::buffer(header_),
                                 boost::asio::buffer(body.data(), body.size())};
    stream_.Write(
        parts, Completion([self = shared_from_this(), body](error_code error, std::size_t length) {
          self->context_->traffic->sent_bytes += length;
          self->OnWritten(error);
        }));
  }

  // Sends the header, then the parts of the stream.
  void WriteStream(const Response& response) {
    tcp().expires_after(limits().request_time);
    header_ = transport::HeaderText(Header(response).base());
    stream_.Write(
        {boost::asio::buffer(header_)},
        Completion([self = shared_from_this(), parts = response.stream](error_code error) {
          if (!error) self->WriteNextPart(parts);
        }));
  }

  void WriteNextPart(const std::shared_ptr<BodyStream>& parts) {
    if (context_->stopping) return OnWritten({});
    tcp().expires_never();  // the stream has its own time limits
    parts->Next([self = shared_from_this(), parts](std::optional<SharedBytes> part) {
      transport::Post(self->stream_.get_executor(),
                      Completion([self, parts, part = std::move(part)] {
                        if (!part) return self->OnWritten({});
                        self->WritePart(parts, *part);
                      }));
    });
  }

  void WritePart(const std::shared_ptr<BodyStream>& parts, const SharedBytes& part) {
    tcp().expires_after(limits().request_time);
    stream_.Write(
        {boost::asio::buffer(part.data(), part.size())},
        Completion([self = shared_from_this(), parts, part](error_code error, std::size_t length) {
          self->context_->traffic->sent_bytes += length;
          if (!error) self->WriteNextPart(parts);
        }));
  }

  void OnWritten(error_code error) {
    if (error) return;
    if (keep_alive_ && !context_->stopping) return Read();
    tcp().expires_after(kLeaveTime);
    stream_.Shutdown(Completion([self = shared_from_this()](error_code) { self->HangUp(); }));
  }

  void HangUp() {
    error_code ignored;
    tcp().socket().shutdown(transport::Socket::shutdown_send, ignored);
    Drain();
  }

  // Reads the remaining bytes of the client. If the socket were closed with unread bytes, the
  // system could discard the response.
  void Drain() {
    is_idle_ = true;
    tcp().expires_after(kLeaveTime);
    buffer_.clear();
    tcp().async_read_some(buffer_.prepare(4096),
                          Completion([self = shared_from_this()](error_code error) {
                            if (!error) self->Drain();
                          }));
  }

  ByteStream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::string header_;  // the header of the response that is being sent
  std::shared_ptr<ServerContext> context_;
  std::unique_ptr<ConnectionSlot> slot_;
  KeepTrack keep_track_;
  // The state of the request that is being read or answered:
  base::Result<Target> target_{};
  Router::Match match_;
  std::optional<access::Principal> principal_;  // nullopt until the client is authenticated
  std::unique_ptr<UploadSlot> upload_;          // set during an upload
  std::uint64_t body_limit_ = 0;
  unsigned version_ = 11;
  bool keep_alive_ = false;
  bool is_head_ = false;
  bool is_idle_ = false;  // whether the session waits for a request that may never come
};

// Reads the first bytes of a connection to a server with TLS. If they begin TLS, an HttpSession
// serves the client. If they are plain HTTP, the client only gets a message that asks for https://.
class TlsDetector final : public Connection, public std::enable_shared_from_this<TlsDetector> {
 public:
  TlsDetector(transport::Socket socket, std::shared_ptr<ServerContext> context,
              std::unique_ptr<ConnectionSlot> slot, KeepTrack keep_track)
      : stream_(std::move(socket)),
        context_(std::move(context)),
        slot_(std::move(slot)),
        keep_track_(std::move(keep_track)) {}

  void Open() {
    tcp().expires_after(std::min(kHandshakeTime, context_->options.limits.request_time));
    stream_.ReadSome(buffer_.prepare(kFirstRead),
                     Completion([self = shared_from_this()](error_code error, std::size_t length) {
                       if (error) return self->tcp().close();
                       self->buffer_.commit(length);
                       const auto* first =
                           static_cast<const unsigned char*>(self->buffer_.cdata().data());
                       *first == kTlsHandshake ? self->ServeTls() : self->RefusePlainHttp();
                     }));
  }

  void Shutdown() override { tcp().close(); }
  void Cut() override { tcp().close(); }

 private:
  transport::TcpStream& tcp() { return stream_.tcp(); }

  void ServeTls() {
    const auto session = std::make_shared<HttpSession>(std::move(stream_), std::move(buffer_),
                                                       context_, std::move(slot_), keep_track_);
    keep_track_(session);
    session->BeginTls();
  }

  void RefusePlainHttp() {
    static constexpr std::string_view kAnswer =
        "HTTP/1.1 400 Bad Request\r\nConnection: close\r\nContent-Type: application/json\r\n\r\n"
        "{\"error\":\"this server speaks HTTPS only; open the address with https://\"}";
    stream_.Write({boost::asio::buffer(kAnswer.data(), kAnswer.size())},
                  Completion([self = shared_from_this()](error_code error) {
                    if (error) return;
                    self->tcp().socket().shutdown(transport::Socket::shutdown_send, error);
                    self->Drain();
                  }));
  }

  // See HttpSession::Drain().
  void Drain() {
    tcp().expires_after(kLeaveTime);
    buffer_.clear();
    stream_.ReadSome(buffer_.prepare(4096),
                     Completion([self = shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->Drain();
                     }));
  }

  ByteStream stream_;
  beast::flat_buffer buffer_;
  const std::shared_ptr<ServerContext> context_;
  std::unique_ptr<ConnectionSlot> slot_;
  const KeepTrack keep_track_;
};

}  // namespace

void StartHttpSession(transport::Socket socket, std::shared_ptr<ServerContext> context,
                      std::unique_ptr<ConnectionSlot> slot,
                      std::function<void(std::weak_ptr<Connection>)> keep_track) {
  if (context->tls != nullptr) {
    const auto door = std::make_shared<TlsDetector>(std::move(socket), std::move(context),
                                                    std::move(slot), keep_track);
    keep_track(door);
    return door->Open();
  }
  const auto session =
      std::make_shared<HttpSession>(ByteStream(std::move(socket)), beast::flat_buffer(),
                                    std::move(context), std::move(slot), keep_track);
  keep_track(session);
  session->Read();
}

}  // namespace gsv::gateway
