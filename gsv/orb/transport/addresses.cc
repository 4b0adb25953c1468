#include "gsv/orb/transport/addresses.h"

#include <fcntl.h>
#include <unistd.h>

#include "gsv/orb/transport/tls_channel.h"

namespace gsv::orb {
namespace {

// The maximum duration of a TLS handshake, also for calls with a longer time limit or without one.
constexpr long kMaxHandshakeSeconds = 10;

IIOP::Address WithHost(const char* host, const IIOP::Address& address) {
  IIOP::Address other;
  other.host = host;
  other.port = address.port;
  return other;
}

// Returns a connected socket, or -1 on failure.
int ConnectSocket(const IIOP::Address& address, const omni_time_t& deadline, CORBA::ULong flags,
                  CORBA::Boolean& timed_out) {
  if (address.port == 0) return -1;
  return omni::tcpSocket::Connect(address.host, address.port, deadline, flags, timed_out);
}

}  // namespace

std::optional<IIOP::Address> ReadHostAndPort(const char* text) {
  IIOP::Address address;
  char* const host = omni::omniURI::extractHostPort(text, address.port);
  if (host == nullptr) return std::nullopt;
  address.host = host;
  return address;
}

omni::giopAddress* TcpAddress::duplicate(const char* host) const {
  return new TcpAddress(WithHost(host, address_));
}

omni::giopActiveConnection* TcpAddress::Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                                CORBA::Boolean& timed_out) const {
  const int socket = ConnectSocket(address_, deadline, flags, timed_out);
  if (socket < 0) return nullptr;
  fcntl(socket, F_SETFD, FD_CLOEXEC);
  return new ActiveConnection(socket, std::make_unique<PlainChannel>(socket),
                              AddressesOfTcp(socket, "giop:tcp"), *CurrentConnectionPolicy());
}

TlsAddress::TlsAddress(std::shared_ptr<const TlsContext> context, const IIOP::Address& address)
    : tcpAddress(address), context_(std::move(context)), address_(address) {
  text_ = omni::omniURI::buildURI("giop:ssl", address.host, address.port);
}

omni::giopAddress* TlsAddress::duplicate(const char* host) const {
  return new TlsAddress(context_, WithHost(host, address_));
}

omni::giopActiveConnection* TlsAddress::Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                                CORBA::Boolean& timed_out) const {
  if (address_.port == 0) return nullptr;
  if (context_ == nullptr) {
    NoteTlsFailure(
        "the server requires TLS and a certificate: set yours with GSV_CORBA_CERTIFICATE");
    return nullptr;
  }
  const int socket = ConnectSocket(address_, deadline, flags, timed_out);
  if (socket < 0) return nullptr;
  fcntl(socket, F_SETFD, FD_CLOEXEC);
  omni_time_t until;
  omni_thread::get_time(until, omni_time_t(kMaxHandshakeSeconds, 0));
  if (deadline && deadline < until) until = deadline;
  auto channel = std::make_unique<TlsChannel>(context_, socket, TlsChannel::Side::kClient);
  bool is_late = false;
  if (channel->AwaitHandshake(until, is_late)) {
    return new ActiveConnection(socket, std::move(channel), AddressesOfTcp(socket, "giop:ssl"),
                                *CurrentConnectionPolicy());
  }
  timed_out = is_late;
  channel.reset();
  close(socket);
  return nullptr;
}

omni::giopActiveConnection* LocalAddress::Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                                  CORBA::Boolean& timed_out) const {
  omni::giopActiveConnection* const plain = unixAddress::Connect(deadline, flags, timed_out);
  if (plain == nullptr) return nullptr;
  // `plain` is omniORB's connection. An ActiveConnection takes over a duplicate of its socket.
  const int socket =
      fcntl(static_cast<omni::unixActiveConnection*>(plain)->handle(), F_DUPFD_CLOEXEC, 0);
  plain->getConnection().decrRefCount(true);
  if (socket < 0) return nullptr;
  return new ActiveConnection(socket, std::make_unique<PlainChannel>(socket),
                              AddressesOfMadeLocal(address()), *CurrentConnectionPolicy());
}

}  // namespace gsv::orb
