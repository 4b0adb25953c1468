#include "gsv/orb/transport/listener.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include <sys/timerfd.h>
#include <unistd.h>

#include "gsv/base/log.h"
#include "gsv/orb/transport/tls_channel.h"

namespace gsv::orb {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kHandshakeTime{10}, kFarewellTime{1};
constexpr std::size_t kMaxPendingHandshakes = 256;  // above this, the oldest handshake is dropped

}  // namespace

// A client whose handshake is not complete, or a rejected client that must still read the reason.
class PendingHandshake : public omni::SocketHolder {
 public:
  PendingHandshake(int socket, omni::SocketCollection& collection,
                   const std::shared_ptr<const TlsContext>& context, ConnectionAddresses addresses)
      : SocketHolder(socket),
        channel_(std::make_unique<TlsChannel>(context, socket, TlsChannel::Side::kServer)),
        addresses_(std::move(addresses)) {
    collection.addSocket(this);
  }
  ~PendingHandshake() override {
    clearSelectable();
    pd_belong_to->removeSocket(this);
    if (channel_ != nullptr) close(pd_socket);
  }

  TlsChannel::Step Proceed() { return is_refused_ ? ReadToTheEnd() : channel_->Handshake(); }
  std::string failure() const { return channel_->failure(); }
  // The unread bytes are read before the socket is closed. If a socket with unread bytes is closed,
  // the peer does not receive the last data that were sent to it.
  void Refuse(const std::string& why) {
    constexpr std::string_view kScheme = "giop:ssl:";
    spdlog::warn("refused a CORBA connection from {}: {}", addresses_.peer.substr(kScheme.size()),
                 why);
    is_refused_ = true;
    until_ = Clock::now() + kFarewellTime;
    shutdown(pd_socket, SHUT_WR);
  }
  bool is_refused() const { return is_refused_; }
  bool is_late(Clock::time_point now) const { return now > until_; }

  // Returns the channel. The caller then also owns the socket.
  std::unique_ptr<TlsChannel> TakeChannel() {
    Leave();
    return std::move(channel_);
  }
  void Leave() { is_gone_ = true; }
  bool is_gone() const { return is_gone_; }
  int socket() const { return pd_socket; }
  const ConnectionAddresses& addresses() const { return addresses_; }

 private:
  TlsChannel::Step ReadToTheEnd() const {
    std::array<char, 4096> ignored{};
    const ssize_t count = recv(pd_socket, ignored.data(), ignored.size(), MSG_DONTWAIT);
    return count > 0 || (count < 0 && errno == EAGAIN) ? TlsChannel::Step::kWantsToRead
                                                       : TlsChannel::Step::kFailed;
  }

  std::unique_ptr<TlsChannel> channel_;
  const ConnectionAddresses addresses_;
  Clock::time_point until_ = Clock::now() + kHandshakeTime;
  bool is_refused_ = false, is_gone_ = false;
};

// A file descriptor that becomes readable every half second after Set(true). Without it, Select()
// might never return.
class Alarm : public omni::SocketHolder {
 public:
  explicit Alarm(omni::SocketCollection& collection)
      : SocketHolder(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
    collection.addSocket(this);
  }
  ~Alarm() override {
    clearSelectable();
    pd_belong_to->removeSocket(this);
    close(pd_socket);
  }

  void Set(bool is_set) {
    constexpr timespec kPeriod{0, 500'000'000};
    const itimerspec times = is_set ? itimerspec{kPeriod, kPeriod} : itimerspec{};
    timerfd_settime(pd_socket, 0, &times, nullptr);
    if (is_set) setSelectable(1, false);
  }
  void Hear() {
    std::uint64_t count = 0;
    (void)!read(pd_socket, &count, sizeof count);
    setSelectable(1, false);
  }
};

Listener::Listener(omni::SocketCollection& collection, std::shared_ptr<const TlsContext> context)
    : collection_(collection), context_(std::move(context)) {}

Listener::~Listener() = default;

omni::giopConnection* Listener::Await(omni::giopConnection::notifyReadable_t readable,
                                      void* cookie) {
  readable_ = readable;
  cookie_ = cookie;
  if (context_ != nullptr && alarm_ == nullptr) alarm_ = std::make_unique<Alarm>(collection_);
  while (!poked_ && accepted_.empty()) {
    if (!collection_.Select()) break;
    if (!pending_handshakes_.empty()) Dismiss();
  }
  if (!poked_ && !accepted_.empty()) {
    Connection* const connection = accepted_.front();
    accepted_.pop_front();
    return connection;
  }
  pending_handshakes_.clear();
  alarm_.reset();
  for (Connection* connection : accepted_) connection->decrRefCount(true);
  accepted_.clear();
  return nullptr;
}

void Listener::Notify(omni::SocketHolder* holder) {
  if (context_ != nullptr) {
    if (holder == alarm_.get()) {
      alarm_->Hear();
      return;
    }
    if (auto* const pending = dynamic_cast<PendingHandshake*>(holder)) {
      Proceed(pending);
      return;
    }
  }
  auto* const connection = static_cast<Connection*>(holder);
  if (!policy_->shall_read || policy_->shall_read(connection)) readable_(cookie_, connection);
}

void Listener::Accept(int socket, ConnectionAddresses addresses) {
  if (context_ == nullptr) {
    AddConnection(socket, std::make_unique<PlainChannel>(socket), std::move(addresses));
    return;
  }
  if (pending_handshakes_.empty()) alarm_->Set(true);
  pending_handshakes_.push_back(
      std::make_unique<PendingHandshake>(socket, collection_, context_, std::move(addresses)));
  pending_handshakes_.back()->setSelectable(1, false);
}

void Listener::AddConnection(int socket, std::unique_ptr<Channel> channel,
                             ConnectionAddresses addresses) {
  accepted_.push_back(
      new Connection(socket, std::move(channel), std::move(addresses), collection_, *policy_));
}

void Listener::Proceed(PendingHandshake* pending) {
  switch (pending->Proceed()) {
    case TlsChannel::Step::kDone:
      AddConnection(pending->socket(), pending->TakeChannel(), pending->addresses());
      return;
    case TlsChannel::Step::kWantsToRead:
      pending->setSelectable(1, false);
      return;
    case TlsChannel::Step::kWantsToWrite:
      // The send buffer of the socket is full. The bytes of a handshake are few, so this happens
      // only if the peer is malicious.
      pending->Refuse("the peer does not read the data of this server");
      break;
    case TlsChannel::Step::kFailed:
      if (pending->is_refused()) {
        pending->Leave();
        return;
      }
      pending->Refuse(pending->failure());
      break;
  }
  pending->setSelectable(1, false);
}

// Called after all notifications of a Select() call, because some notifications may be for
// handshakes that Dismiss() destroys.
void Listener::Dismiss() {
  const Clock::time_point now = Clock::now();
  std::size_t surplus =
      pending_handshakes_.size() - std::min(pending_handshakes_.size(), kMaxPendingHandshakes);
  std::erase_if(pending_handshakes_, [&](const std::unique_ptr<PendingHandshake>& pending) {
    if (pending->is_gone()) return true;
    if (surplus > 0) {
      --surplus;
      return true;
    }
    if (!pending->is_late(now)) return false;
    if (!pending->is_refused()) pending->Refuse("the peer did not finish the TLS handshake");
    return true;
  });
  if (pending_handshakes_.empty()) alarm_->Set(false);
}

}  // namespace gsv::orb
