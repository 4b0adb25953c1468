#include "gsv/orb/endpoint.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <string_view>

#include <sys/timerfd.h>
#include <unistd.h>

#include "gsv/base/log.h"
#include "gsv/orb/whole_transport.h"

namespace gsv::orb {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kHandshakeTime{10}, kFarewellTime{1};
constexpr std::size_t kMostNewcomers = 256;  // beyond them the one that came first goes

}  // namespace

// Who has not shown its certificate yet, or was refused and is to read why.
class Newcomer : public omni::SocketHolder {
 public:
  Newcomer(int socket, omni::SocketCollection* collection,
           const std::shared_ptr<const TlsContext>& context)
      : SocketHolder(socket),
        channel_(std::make_unique<TlsChannel>(context, socket, TlsChannel::Side::kServer)),
        peer_(TlsAddressOf(socket, getpeername).in()) {
    collection->addSocket(this);
  }
  ~Newcomer() override {
    clearSelectable();
    pd_belong_to->removeSocket(this);
    if (channel_ != nullptr) close(pd_socket);
  }

  TlsChannel::Step Proceed() { return is_refused_ ? ReadToTheEnd() : channel_->Handshake(); }
  const std::string& failure() const { return channel_->failure(); }
  // What it was told is lost if its socket is closed while bytes of it are unread.
  void Refuse(const std::string& why) {
    constexpr std::string_view kTransport = "giop:ssl:";
    spdlog::warn("refused a CORBA connection from {}: {}", peer_.substr(kTransport.size()), why);
    is_refused_ = true;
    until_ = Clock::now() + kFarewellTime;
    shutdown(pd_socket, SHUT_WR);
  }
  bool is_refused() const { return is_refused_; }
  bool is_late(Clock::time_point now) const { return now > until_; }

  // With its socket, which is then another's.
  std::unique_ptr<TlsChannel> TakeChannel() {
    Leave();
    return std::move(channel_);
  }
  void Leave() { is_gone_ = true; }
  bool is_gone() const { return is_gone_; }
  int socket() const { return pd_socket; }

 private:
  TlsChannel::Step ReadToTheEnd() const {
    std::array<char, 4096> ignored{};
    const ssize_t count = recv(pd_socket, ignored.data(), ignored.size(), MSG_DONTWAIT);
    return count > 0 || (count < 0 && errno == EAGAIN) ? TlsChannel::Step::kWantsToRead
                                                       : TlsChannel::Step::kFailed;
  }

  std::unique_ptr<TlsChannel> channel_;
  const std::string peer_;
  Clock::time_point until_ = Clock::now() + kHandshakeTime;
  bool is_refused_ = false, is_gone_ = false;
};

// Becomes readable now and then as long as it is set, since Select() may sleep for ever.
class Alarm : public omni::SocketHolder {
 public:
  explicit Alarm(omni::SocketCollection* collection)
      : SocketHolder(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
    collection->addSocket(this);
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

Endpoint::Endpoint(const char* address, std::shared_ptr<const TlsContext> context)
    : tcpEndpoint(address), context_(std::move(context)) {}

Endpoint::~Endpoint() = default;

const char* Endpoint::type() const { return context_ != nullptr ? "giop:ssl" : "giop:tcp"; }

CORBA::Boolean Endpoint::publish(const omni::orbServer::PublishSpecs& specifications,
                                 CORBA::Boolean all_specifications, CORBA::Boolean all_endpoints,
                                 omni::orbServer::EndpointList& published) {
  if (context_ == nullptr) {
    return tcpEndpoint::publish(specifications, all_specifications, all_endpoints, published);
  }
  // The addresses themselves, as is omniORB's default; it names no others of TLS.
  const omni::orbServer::EndpointList& own = *addresses();
  const CORBA::ULong count = all_endpoints ? own.length() : std::min<CORBA::ULong>(own.length(), 1);
  for (CORBA::ULong i = 0; i < count; ++i) {
    omni::giopEndpoint::addToIOR(own[i]);
    published.length(published.length() + 1);
    published[published.length() - 1] = own[i];
  }
  return count > 0;
}

omni::giopConnection* Endpoint::AcceptAndMonitor(omni::giopConnection::notifyReadable_t readable,
                                                 void* cookie) {
  readable_ = readable;
  cookie_ = cookie;
  if (context_ != nullptr && alarm_ == nullptr) alarm_ = std::make_unique<Alarm>(this);
  setSelectable(1, false);
  while (!poked_ && accepted_.empty()) {
    if (!Select()) break;
    if (!newcomers_.empty()) Dismiss();
  }
  if (!poked_ && !accepted_.empty()) {
    Connection* const connection = accepted_.front();
    accepted_.pop_front();
    return connection;
  }
  newcomers_.clear();
  alarm_.reset();
  for (Connection* connection : accepted_) connection->decrRefCount(true);
  accepted_.clear();
  return nullptr;
}

void Endpoint::Poke() {
  poked_ = true;
  tcpEndpoint::Poke();
}

CORBA::Boolean Endpoint::notifyReadable(omni::SocketHolder* holder) {
  if (holder == static_cast<omni::SocketHolder*>(this)) {
    const int accepted = accept4(pd_socket, nullptr, nullptr, SOCK_CLOEXEC);
    if (accepted < 0 && errno == EBADF) return false;
    if (accepted >= 0) Accept(accepted);
    setSelectable(1, false);
    return true;
  }
  if (context_ != nullptr) {
    if (holder == alarm_.get()) {
      alarm_->Hear();
      return true;
    }
    if (auto* const newcomer = dynamic_cast<Newcomer*>(holder)) {
      Proceed(newcomer);
      return true;
    }
  }
  auto* const connection = static_cast<Connection*>(holder);
  if (ShallRead(connection)) readable_(cookie_, connection);
  return true;
}

void Endpoint::Accept(int socket) {
  if (context_ == nullptr) {
    accepted_.push_back(MakeConnection(socket, nullptr));
    return;
  }
  if (newcomers_.empty()) alarm_->Set(true);
  newcomers_.push_back(std::make_unique<Newcomer>(socket, this, context_));
  newcomers_.back()->setSelectable(1, false);
}

void Endpoint::Proceed(Newcomer* newcomer) {
  switch (newcomer->Proceed()) {
    case TlsChannel::Step::kDone:
      accepted_.push_back(MakeConnection(newcomer->socket(), newcomer->TakeChannel()));
      return;
    case TlsChannel::Step::kWantsToRead:
      newcomer->setSelectable(1, false);
      return;
    case TlsChannel::Step::kWantsToWrite:
      // The few bytes of a handshake always find room, but with those who mean harm.
      newcomer->Refuse("it does not read");
      break;
    case TlsChannel::Step::kFailed:
      if (newcomer->is_refused()) {
        newcomer->Leave();
        return;
      }
      newcomer->Refuse(newcomer->failure());
      break;
  }
  newcomer->setSelectable(1, false);
}

// After the notifications of a round, as some may be of those who go.
void Endpoint::Dismiss() {
  const Clock::time_point now = Clock::now();
  std::size_t surplus = newcomers_.size() - std::min(newcomers_.size(), kMostNewcomers);
  std::erase_if(newcomers_, [&](const std::unique_ptr<Newcomer>& newcomer) {
    if (newcomer->is_gone()) return true;
    if (surplus > 0) {
      --surplus;
      return true;
    }
    if (!newcomer->is_late(now)) return false;
    if (!newcomer->is_refused()) newcomer->Refuse("it did not finish the handshake of TLS");
    return true;
  });
  if (newcomers_.empty()) alarm_->Set(false);
}

Connection* Endpoint::MakeConnection(int socket, std::unique_ptr<TlsChannel> channel) {
  return new WholeMessages<Connection>(CurrentMessageLimits(), std::move(channel), socket, this);
}

bool Endpoint::ShallRead(Connection* /*connection*/) { return true; }

}  // namespace gsv::orb
