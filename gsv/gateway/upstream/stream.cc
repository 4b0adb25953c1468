#include "gsv/gateway/upstream/stream.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <optional>
#include <utility>

#include <boost/beast/core/flat_buffer.hpp>

#include "gsv/gateway/http/target.h"
#include "gsv/gateway/transport/connector.h"
#include "gsv/gateway/transport/websocket.h"
#include "gsv/gateway/upstream/channel_map.h"
#include "gsv/gateway/upstream/secure.h"

namespace gsv::gateway::upstream {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using std::chrono::milliseconds;
using std::chrono::seconds;
using transport::Completion;
using transport::WebSocket;

// Maximum size of a message: enough for an image, or for the list of two thousand channels with
// their definitions.
constexpr std::size_t kMaxMessageBytes = 64u << 20;
constexpr seconds kConnectTime{10};
constexpr seconds kIdleTime{30};
constexpr milliseconds kFirstPause{200}, kMaxPause{5000};

foxglove::ServerInfo InfoOf(const Address& address, const std::string& simulation) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {"gsv relay of " + address.Url(),
          {"time"},
          {{"simulation", simulation}},
          std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(now).count())};
}

// One attempt to connect, from resolving the name to the end of the connection. Pending operations
// keep their attempt alive. If the attempt was abandoned meanwhile, their results are ignored.
struct Attempt {
  explicit Attempt(asio::io_context& io) : connector(io), socket(io) {}

  void Abandon() {
    connector.Cancel();
    socket.next_layer().tcp().close();
  }

  transport::Connector connector;
  WebSocket socket;
  websocket::response_type answer;  // the answer to the handshake
  beast::flat_buffer incoming;
  std::deque<std::string> outgoing;  // messages to send; the first one is being written
};
using AttemptPointer = std::shared_ptr<Attempt>;

class RemoteStream final : public Stream, public std::enable_shared_from_this<RemoteStream> {
 public:
  RemoteStream(asio::io_context& io, const Address& address, const std::string& simulation,
               const std::string& socket)
      : io_(io), address_(address), simulation_(simulation), socket_(socket), pause_(io) {}

  void Open(std::shared_ptr<Operations> operations) {
    hub_ = std::make_shared<Hub>(
        InfoOf(address_, simulation_),
        [weak = weak_from_this()] {
          if (const auto self = weak.lock()) self->OnDemand();
        },
        std::move(operations));
    channels_.emplace(hub_);
  }

  const std::shared_ptr<Hub>& hub() const override { return hub_; }
  bool has_ended() const override { return has_ended_; }

  void Stop() override {
    transport::Post(io_.get_executor(), Completion([self = shared_from_this()] {
                      self->is_stopped_ = true;
                      self->Disconnect();
                    }));
  }

 private:
  // Called from any thread: a client was added or removed, subscribed or unsubscribed.
  void OnDemand() {
    if (is_called_.exchange(true)) return;
    transport::Post(io_.get_executor(), Completion([self = shared_from_this()] {
                      self->is_called_ = false;
                      self->FollowDemand();
                    }));
  }

  void FollowDemand() {
    if (is_stopped_ || has_ended_) return;
    hub_->PublishChanges();
    if (!hub_->has_clients()) return Disconnect();
    if (state_ == State::kIdle) return Connect();
    if (state_ != State::kOpen) return;
    for (std::string& text : channels_->FollowDemand()) Send(std::move(text));
    channels_->ServeNewSubscribers();
  }

  // Returns a handler for the current attempt. It does nothing if this attempt was abandoned before
  // the handler runs.
  Completion ForThis(void (*then)(RemoteStream&, error_code)) {
    return Completion([self = shared_from_this(), attempt = attempt_, then](error_code error) {
      if (attempt == self->attempt_) then(*self, error);
    });
  }

  void Connect() {
    state_ = State::kConnecting;
    attempt_ = std::make_shared<Attempt>(io_);
    attempt_->connector.Connect(attempt_->socket.next_layer(), address_.host, address_.port,
                                kConnectTime, ForThis([](RemoteStream& self, error_code error) {
                                  if (error) return self.TryAgain(error.message());
                                  self.BeginTls();
                                }));
  }

  void BeginTls() {
    StartTls(attempt_->socket.next_layer(), address_,
             ForThis([](RemoteStream& self, error_code error) {
               if (error) return self.TryAgain(WhyNotConnected(error));
               self.Handshake();
             }));
  }

  void Handshake() {
    WebSocket& socket = attempt_->socket;
    socket.next_layer().tcp().expires_never();
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = kConnectTime;
    timeout.idle_timeout = kIdleTime;
    timeout.keep_alive_pings = true;
    socket.set_option(timeout);
    socket.read_message_max(kMaxMessageBytes);
    socket.set_option(websocket::stream_base::decorator([this](websocket::request_type& request) {
      if (!address_.token.empty()) {
        request.set(beast::http::field::authorization, "Bearer " + address_.token);
      }
      request.set(beast::http::field::user_agent, "gsv");
      request.set(
          beast::http::field::sec_websocket_protocol,
          std::string(foxglove::kSubprotocols[0]) + ", " + std::string(foxglove::kSubprotocols[1]));
    }));
    const std::string target =
        simulation_.empty() ? socket_ : socket_ + "?simulation=" + Escape(simulation_);
    socket.async_handshake(
        attempt_->answer, address_.Authority(), target,
        ForThis([](RemoteStream& self, error_code error) { self.OnHandshake(error); }));
  }

  void OnHandshake(error_code error) {
    const auto& answer = attempt_->answer;
    const bool is_refused = error == websocket::error::upgrade_declined;
    if (is_refused && answer.result() == beast::http::status::not_found) return End();
    if (is_refused) {
      return TryAgain("it returns " + std::to_string(answer.result_int()) + " " +
                      std::string(answer.reason()));
    }
    if (error) return TryAgain(error.message());
    state_ = State::kOpen;
    pause_length_ = kFirstPause;
    Read();
  }

  void Read() {
    attempt_->socket.async_read(attempt_->incoming,
                                ForThis([](RemoteStream& self, error_code error) {
                                  if (error) return self.TryAgain(self.LastWords(error));
                                  self.OnMessage();
                                }));
  }

  std::string LastWords(error_code error) const {
    const auto& reason = attempt_->socket.reason().reason;
    return reason.empty() ? error.message() : std::string(reason.data(), reason.size());
  }

  void OnMessage() {
    const AttemptPointer attempt = attempt_;  // a copy, because a message may end the attempt
    const auto data = attempt->incoming.cdata();
    const std::string_view bytes(static_cast<const char*>(data.data()), data.size());
    const base::Status taken = attempt->socket.got_text() ? TakeText(bytes) : TakeData(bytes);
    attempt->incoming.clear();
    if (attempt != attempt_) return;
    if (!taken) return TryAgain(taken.error().message);
    Read();
  }

  base::Status TakeText(std::string_view bytes) {
    const base::Result<ServerText> text = ParseServerText(bytes);
    if (!text) return base::Fail(text.error());
    std::visit([this](const auto& message) { Handle(message); }, *text);
    return {};
  }

  base::Status TakeData(std::string_view bytes) {
    const base::Result<ServerData> data = ParseServerData(bytes);
    if (!data) return base::Fail(data.error());
    std::visit([this](const auto& message) { Handle(message); }, *data);
    return {};
  }

  void Handle(const Advertise& message) {
    channels_->Handle(message);
    FollowDemand();
  }
  void Handle(const Unadvertise& message) {
    channels_->Handle(message);
    hub_->PublishChanges();
  }
  void Handle(const StatusMessage& message) { hub_->SendStatus(message.level, message.message); }
  void Handle(const MessageData& message) { channels_->Handle(message); }
  void Handle(const Time& message) { hub_->PublishTime(message.time_ns); }
  void Handle(const Other&) {}

  void Send(std::string text) {
    attempt_->outgoing.push_back(std::move(text));
    if (attempt_->outgoing.size() == 1) WriteNext();
  }

  void WriteNext() {
    attempt_->socket.text(true);
    const transport::FrameParts parts{asio::buffer(attempt_->outgoing.front())};
    attempt_->socket.async_write(parts, ForThis([](RemoteStream& self, error_code error) {
                                   if (error) return self.TryAgain(error.message());
                                   self.attempt_->outgoing.pop_front();
                                   if (!self.attempt_->outgoing.empty()) self.WriteNext();
                                 }));
  }

  void Disconnect() {
    state_ = State::kIdle;
    pause_.cancel();
    if (attempt_) attempt_->Abandon();
    attempt_ = nullptr;
    channels_->Clear();
  }

  void TryAgain(const std::string& why) {
    const bool was_open = state_ == State::kOpen;
    Disconnect();
    if (was_open || pause_length_ == kFirstPause) {
      hub_->SendStatus(foxglove::StatusLevel::kWarning,
                       address_.Url() + ": connection lost: " + why + "; trying again");
    }
    state_ = State::kPausing;
    pause_.expires_after(pause_length_);
    pause_length_ = std::min(2 * pause_length_, kMaxPause);
    Wait(pause_, Completion([self = shared_from_this()](error_code error) {
           if (error || self->state_ != State::kPausing) return;
           self->state_ = State::kIdle;
           self->FollowDemand();
         }));
  }

  void End() {
    Disconnect();
    has_ended_ = true;
    hub_->Close(CloseCode::kGoingAway,
                simulation_.empty()
                    ? "there is no simulation at " + address_.Url()
                    : "the simulation '" + simulation_ + "' does not exist any more");
  }

  // kIdle: not connected, because there are no viewers. kPausing: waits before the next attempt.
  enum class State { kIdle, kConnecting, kOpen, kPausing };

  asio::io_context& io_;
  const Address address_;
  const std::string simulation_;
  const std::string socket_;
  std::shared_ptr<Hub> hub_;
  std::optional<ChannelMap> channels_;
  transport::Timer pause_;
  AttemptPointer attempt_;  // null between attempts
  State state_ = State::kIdle;
  milliseconds pause_length_ = kFirstPause;
  bool is_stopped_ = false;
  std::atomic<bool> is_called_{false};
  std::atomic<bool> has_ended_{false};
};

}  // namespace

std::shared_ptr<Stream> Stream::Make(asio::io_context& io, const Address& address,
                                     const std::string& simulation, const std::string& socket,
                                     std::shared_ptr<Operations> operations) {
  auto stream = std::make_shared<RemoteStream>(io, address, simulation, socket);
  stream->Open(std::move(operations));
  return stream;
}

}  // namespace gsv::gateway::upstream
