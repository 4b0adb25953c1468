#include "gsv/gateway/server/websocket_session.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <optional>
#include <utility>

#include <boost/beast/core/flat_buffer.hpp>

#include "gsv/gateway/server/send_window.h"
#include "gsv/gateway/transport/websocket.h"

namespace gsv::gateway {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using transport::Completion;
using HttpRequest = beast::http::request<beast::http::string_body>;

// Maximum number of bytes that one read takes from the socket.
constexpr std::size_t kReadSize = 16u << 10;
// Time limit for a client to receive pending messages before the connection is closed.
constexpr std::chrono::seconds kCloseTimeout{2};
// Time between two checks whether a slow connection is fast again. The timer is needed because the
// server may have no further messages for the client.
constexpr std::chrono::seconds kSlowCheckInterval{1};
constexpr std::string_view kSlowSentence =
    "The connection is slow: the server leaves out older updates, so that the newest ones arrive "
    "in time.";

// Makes the payload of a close frame. A payload has at most 125 bytes, including two for the code,
// so the text may be truncated.
websocket::close_reason Reason(CloseCode code, const std::string& text) {
  const std::size_t length = std::min(text.size(), websocket::reason_string::max_size_n);
  return {static_cast<websocket::close_code>(code), beast::string_view(text.data(), length)};
}

class WebSocketSession final : public Client,
                               public Connection,
                               public std::enable_shared_from_this<WebSocketSession> {
 public:
  WebSocketSession(transport::ByteStream stream, HttpRequest request, std::shared_ptr<Hub> hub,
                   std::shared_ptr<ServerContext> context, std::unique_ptr<ConnectionSlot> slot,
                   SocketOwner owner)
      : stream_(std::move(stream)),
        farewell_(stream_.get_executor()),
        expiry_(stream_.get_executor()),
        slow_look_(stream_.get_executor()),
        request_(std::move(request)),
        hub_(std::move(hub)),
        context_(std::move(context)),
        slot_(std::move(slot)),
        owner_(std::move(owner)),
        queue_(limits().send) {}

  void Accept(std::string_view subprotocol) {
    subprotocol_ = subprotocol;
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = std::chrono::seconds(10);
    timeout.idle_timeout = limits().idle_time;
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.set_option(websocket::stream_base::decorator(
        [name = std::string(subprotocol)](websocket::response_type& response) {
          response.set(beast::http::field::server, "gsv");
          response.set(beast::http::field::sec_websocket_protocol, name);
        }));
    stream_.auto_fragment(false);
    stream_.control_callback([this](websocket::frame_type type, beast::string_view content) {
      if (type == websocket::frame_type::pong) OnPong({content.data(), content.size()});
    });
    // 0: the stream has no limit. OnRead() checks the size, and sends the reason for a refusal.
    stream_.read_message_max(0);
    stream_.async_accept(request_, Completion([self = shared_from_this()](error_code error) {
                           if (!error) self->OnAccepted();
                         }));
  }

  void SendText(SharedBytes text) override { SendControl(std::move(text), true); }
  void SendBytes(SharedBytes bytes) override { SendControl(std::move(bytes), false); }

  void SendData(const foxglove::BinaryHeader& header, SharedBytes payload,
                Delivery delivery) override {
    context_->traffic->dropped_updates +=
        queue_.PushData(header, std::move(payload), delivery, SendWindow::Clock::now());
    Wake();
  }

  std::uint64_t dropped_updates() const override { return queue_.dropped(); }
  double slow_rate() const override { return slow_rate_; }

  base::Status CheckControl() override {
    if (owner_.is_private) return {};
    if (owner_.principal.permission == Permission::kControl) {
      return context_->handler.CheckControl(owner_.viewer, hub_->simulation());
    }
    return base::Fail(base::ErrorCode::kNotRunning,
                      context_->authenticator->Refusal(owner_.principal, Permission::kControl));
  }

  void Close(CloseCode code, std::string reason) override {
    transport::Post(stream_.get_executor(),
                    Completion([self = shared_from_this(), code, reason = std::move(reason)] {
                      self->BeginClose(code, reason);
                    }));
  }

  void Shutdown() override { BeginClose(CloseCode::kGoingAway, "the server is shutting down"); }
  void Cut() override { Leave(); }

 private:
  const ServerLimits& limits() const { return context_->options.limits; }

  void SendControl(SharedBytes message, bool is_text) {
    if (queue_.PushControl(std::move(message), is_text)) return Wake();
    Close(CloseCode::kTryAgainLater,
          "this viewer is too slow: it does not read its messages; connect again");
  }

  void OnAccepted() {
    request_ = {};
    is_open_ = true;
    is_counted_ = true;
    ++context_->traffic->viewers;
    hub_->Add(shared_from_this(), subprotocol_);
    CloseWhenExpired();
    if (close_reason_) return WriteNext();
    Read();
  }

  void CloseWhenExpired() {
    if (!owner_.principal.expires) return;
    expiry_.expires_at(*owner_.principal.expires);
    Wait(expiry_, Completion([weak = weak_from_this()](error_code error) {
           const auto self = weak.lock();
           if (error || !self) return;
           self->BeginClose(CloseCode::kPolicyViolation,
                            "your permission has expired; connect again");
         }));
  }

  void Read() {
    stream_.async_read_some(
        buffer_, kReadSize,
        Completion([self = shared_from_this()](error_code error) { self->OnRead(error); }));
  }

  void OnRead(error_code error) {
    if (error) return Leave();
    if (close_reason_) {
      buffer_.clear();
    } else if (buffer_.size() > limits().message_bytes) {
      Refuse(CloseCode::kTooBig,
             "a message is longer than " + std::to_string(limits().message_bytes) + " bytes");
    } else if (stream_.is_message_done()) {
      TakeMessage();
    }
    Read();  // this also applies while closing, because the client's close frame must be read
  }

  void TakeMessage() {
    const std::string_view message(static_cast<const char*>(buffer_.cdata().data()),
                                   buffer_.size());
    const base::Status taken =
        stream_.got_text() ? hub_->Receive(this, message) : hub_->ReceiveBytes(this, message);
    if (!taken) Refuse(CloseCode::kPolicyViolation, taken.error().Sentence());
    buffer_.clear();
  }

  // Closes the connection. Sends the complete sentence as a status message, and its beginning as
  // the reason in the close frame.
  void Refuse(CloseCode code, const std::string& sentence) {
    buffer_.clear();
    SendStatus(foxglove::StatusLevel::kError, sentence);
    BeginClose(code, sentence);
  }

  // Starts to write the queue, on this session's thread. Any thread may call it.
  void Wake() {
    if (is_woken_.exchange(true)) return;
    transport::Post(stream_.get_executor(), Completion([self = shared_from_this()] {
                      self->is_woken_ = false;
                      self->WriteNext();
                    }));
  }

  void WriteNext() {
    if (!is_open_ || is_writing_) return;
    const auto now = SendWindow::Clock::now();
    // While the server closes a connection, it sends only control messages. But if the server ends,
    // it also sends the final state, such as the end of a run.
    const bool allows_data = close_reason_ ? sends_all_ : window_.is_open();
    SendQueue::Popped popped = queue_.Pop(now, allows_data);
    if (popped.left_out > 0) {
      context_->traffic->dropped_updates += popped.left_out;
      window_.LeftOut(now);
    }
    if (popped.message) return Write(std::move(*popped.message));
    if (close_reason_) return SendCloseFrame();
    if (!allows_data && queue_.has_data()) window_.HoldBack();
  }

  void Write(Outgoing message) {
    is_writing_ = true;
    write_started_ = SendWindow::Clock::now();
    in_flight_ = std::move(message);
    stream_.text(in_flight_.is_text);
    const transport::FrameParts parts{
        boost::asio::buffer(in_flight_.header.bytes.data(), in_flight_.header.size),
        boost::asio::buffer(in_flight_.payload.data(), in_flight_.payload.size())};
    stream_.async_write(
        parts, Completion([self = shared_from_this()](error_code error, std::size_t length) {
          self->OnWritten(error, length);
        }));
  }

  void OnWritten(error_code error, std::size_t length) {
    context_->traffic->sent_bytes += length;
    is_writing_ = false;
    const bool is_data = std::exchange(in_flight_, {}).is_data;
    if (error) return Leave();
    window_.Sent(length, is_data, write_started_);
    PingIfWanted(write_started_);
    WriteNext();
  }

  // Only a pong opens the window again. So call this after each write and each pong: if the window
  // was closed and no ping were sent, it would stay closed.
  void PingIfWanted(SendWindow::Time started) {
    if (window_.WantsPing(SendWindow::Clock::now())) Ping(started);
  }

  void Ping(SendWindow::Time started) {
    // During a write, the ping would be sent after bytes that the window does not count yet.
    // PingIfWanted() is called again at the end of the write.
    if (is_pinging_ || is_writing_ || !is_open_ || close_reason_) return;
    is_pinging_ = true;
    const std::string number = std::to_string(window_.Ping(SendWindow::Clock::now(), started));
    stream_.async_ping(websocket::ping_data(number.data(), number.size()),
                       Completion([self = shared_from_this()](error_code error) {
                         self->is_pinging_ = false;
                         // If the pong has already arrived, another ping may be due.
                         if (!error) self->PingIfWanted(SendWindow::Clock::now());
                       }));
  }

  // Called while the stream reads. The pings that keep the connection alive have no content.
  void OnPong(std::string_view content) {
    const auto now = SendWindow::Clock::now();
    if (content.empty()) {
      window_.PongOfAny(now);
    } else {
      std::uint64_t number = 0;
      const auto parsed = std::from_chars(content.begin(), content.end(), number);
      if (parsed.ec != std::errc() || parsed.ptr != content.end()) return;
      window_.Pong(number, now);
    }
    PingIfWanted(SendWindow::Clock::now());
    ReportSlowness();
    Wake();
  }

  void ReportSlowness() {
    const bool is_slow = window_.IsSlow(SendWindow::Clock::now());
    slow_rate_ = is_slow ? window_.slow_rate().value_or(0) : 0;
    if (std::exchange(is_slow_, is_slow) == is_slow) return;
    if (!is_slow)
      return SendText(SharedBytes(foxglove::RemoveStatusText(foxglove::kSlowConnectionId)));
    SendText(SharedBytes(foxglove::StatusText(foxglove::StatusLevel::kWarning, kSlowSentence,
                                              foxglove::kSlowConnectionId)));
    LookAgain();
  }

  void LookAgain() {
    slow_look_.expires_after(kSlowCheckInterval);
    Wait(slow_look_, Completion([weak = weak_from_this()](error_code error) {
           const auto self = weak.lock();
           if (error || !self || self->has_left_) return;
           if (!self->window_.is_pinging()) self->Ping(SendWindow::Clock::now());
           self->ReportSlowness();
           if (self->is_slow_) self->LookAgain();
         }));
  }

  void BeginClose(CloseCode code, const std::string& reason) {
    if (close_reason_) return;
    close_reason_ = Reason(code, reason);
    sends_all_ = code == CloseCode::kGoingAway;
    farewell_.expires_after(kCloseTimeout);
    Wait(farewell_, Completion([weak = weak_from_this()](error_code error) {
           const auto self = weak.lock();
           if (!error && self) self->stream_.next_layer().tcp().close();
         }));
    WriteNext();
  }

  void SendCloseFrame() {
    is_open_ = false;
    stream_.async_close(*close_reason_, Completion([self = shared_from_this()] { self->Leave(); }));
  }

  void Leave() {
    is_open_ = false;
    farewell_.cancel();
    expiry_.cancel();
    slow_look_.cancel();
    if (std::exchange(has_left_, true)) return;
    if (is_counted_) --context_->traffic->viewers;
    stream_.next_layer().tcp().close();  // also ends a blocked write
    hub_->Remove(this);
  }

  transport::WebSocket stream_;
  bool sends_all_ = false;  // whether data messages are also sent before the connection is closed
  transport::Timer farewell_, expiry_, slow_look_;
  HttpRequest request_;
  beast::flat_buffer buffer_;
  std::shared_ptr<Hub> hub_;
  std::shared_ptr<ServerContext> context_;
  std::unique_ptr<ConnectionSlot> slot_;
  const SocketOwner owner_;
  std::string subprotocol_;
  SendQueue queue_;
  SendWindow window_;
  Outgoing in_flight_;
  SendWindow::Time write_started_{};
  std::optional<websocket::close_reason> close_reason_;
  std::atomic<bool> is_woken_{false};
  bool is_open_ = false;  // whether the connection was accepted, and no close frame was sent
  bool is_writing_ = false;
  bool is_pinging_ = false;  // whether a ping is being written
  bool is_slow_ = false;     // whether the client has the status message about its slow connection
  std::atomic<double> slow_rate_{0};
  bool has_left_ = false;
  bool is_counted_ = false;  // whether the session counts as a viewer
};

}  // namespace

std::weak_ptr<Connection> StartWebSocketSession(transport::ByteStream stream, HttpRequest request,
                                                std::string_view subprotocol,
                                                std::shared_ptr<Hub> hub,
                                                std::shared_ptr<ServerContext> context,
                                                std::unique_ptr<ConnectionSlot> slot,
                                                SocketOwner owner) {
  const auto session =
      std::make_shared<WebSocketSession>(std::move(stream), std::move(request), std::move(hub),
                                         std::move(context), std::move(slot), std::move(owner));
  session->Accept(subprotocol);
  return session;
}

}  // namespace gsv::gateway
