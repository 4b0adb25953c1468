#include "gsv/orb/tls_transport.h"

#include <unistd.h>

#include <omniORB4/omniURI.h>

#include "gsv/orb/endpoint.h"

// They need the connection's.
// clang-format off
#include <omniORB4/omniIOR.h>
#include <omniORB4/tcpAddress.h>
// clang-format on

namespace gsv::orb {
namespace {

constexpr long kLongestHandshakeSeconds = 10;  // of calls that may take longer, or for ever

bool ReadAddress(const char* text, IIOP::Address& address) {
  char* const host = omni::omniURI::extractHostPort(text, address.port);
  if (host == nullptr) return false;
  address.host = host;
  return true;
}

class TlsAddress : public omni::tcpAddress {
 public:
  TlsAddress(TlsTransport& transport, const IIOP::Address& address)
      : tcpAddress(address), transport_(transport), address_(address) {
    text_ = omni::omniURI::buildURI("giop:ssl", address.host, address.port);
  }

  const char* type() const override { return "giop:ssl"; }
  const char* address() const override { return text_; }
  omni::giopAddress* duplicate() const override { return new TlsAddress(transport_, address_); }
  omni::giopAddress* duplicate(const char* host) const override {
    IIOP::Address address;
    address.host = host;
    address.port = address_.port;
    return new TlsAddress(transport_, address);
  }
  omni::giopActiveConnection* Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                      CORBA::Boolean& timed_out) const override {
    if (address_.port == 0) return nullptr;
    if (transport_.context() == nullptr) {
      NoteTlsFailure("it takes TLS, and a certificate: name yours with GSV_CORBA_CERTIFICATE");
      return nullptr;
    }
    const omni::SocketHandle_t socket =
        omni::tcpSocket::Connect(address_.host, address_.port, deadline, flags, timed_out);
    if (socket < 0) return nullptr;
    omni_time_t until;
    omni_thread::get_time(until, omni_time_t(kLongestHandshakeSeconds, 0));
    if (deadline && deadline < until) until = deadline;
    auto channel =
        std::make_unique<TlsChannel>(transport_.context(), socket, TlsChannel::Side::kClient);
    bool is_late = false;
    if (channel->AwaitHandshake(until, is_late)) {
      return transport_.MakeConnection(socket, std::move(channel));
    }
    timed_out = is_late;
    channel.reset();
    close(socket);
    return nullptr;
  }

 private:
  TlsTransport& transport_;
  IIOP::Address address_;
  CORBA::String_var text_;
};

}  // namespace

TlsTransport::TlsTransport(std::shared_ptr<const TlsContext> context)
    : giopTransportImpl("giop:ssl"), context_(std::move(context)) {}

omni::giopEndpoint* TlsTransport::toEndpoint(const char* address) {
  const bool is_possible = context_ != nullptr && omni::omniURI::validHostPortRange(address);
  return is_possible ? new Endpoint(address, context_) : nullptr;
}

omni::giopAddress* TlsTransport::toAddress(const char* text) {
  IIOP::Address address;
  return ReadAddress(text, address) ? new TlsAddress(*this, address) : nullptr;
}

CORBA::Boolean TlsTransport::isValid(const char* text) {
  return omni::omniURI::validHostPort(text);
}

CORBA::Boolean TlsTransport::addToIOR(const char* text, omni::IORPublish* published) {
  // Integrity, confidentiality, trust in the target and in the client (CSIv2, CORBA 3.1 part 2,
  // 10.5.1.1): it supports and requires them all.
  constexpr CORBA::UShort kAll = 0x66;
  IIOP::Address address;
  if (!ReadAddress(text, address)) return false;
  omniIOR::add_TAG_SSL_SEC_TRANS(address, kAll, kAll, published);
  return true;
}

const omnivector<const char*>* TlsTransport::getInterfaceAddress() {
  return omni::giopTransportImpl::getInterfaceAddress("giop:tcp");
}

omni::giopActiveConnection* TlsTransport::MakeConnection(int socket,
                                                         std::unique_ptr<TlsChannel> channel) {
  return new ActiveConnection(std::move(channel), socket);
}

}  // namespace gsv::orb
