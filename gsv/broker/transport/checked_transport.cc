#include "gsv/broker/transport/checked_transport.h"

#include <memory>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/broker/transport/checked_connection.h"
#include "gsv/orb/endpoint.h"
#include "gsv/orb/tls_transport.h"

// They need the connection's.
// clang-format off
#include <omniORB4/tcpAddress.h>
#include <omniORB4/tcpTransportImpl.h>
// clang-format on

namespace gsv::broker {
namespace {

class CheckedEndpoint : public orb::Endpoint {
 public:
  CheckedEndpoint(const char* address, std::shared_ptr<const orb::TlsContext> context,
                  std::size_t connections)
      : Endpoint(address, std::move(context)),
        table_(std::make_shared<ConnectionTable>(connections)) {}

 protected:
  orb::Connection* MakeConnection(int socket, std::unique_ptr<orb::TlsChannel> channel) override {
    return new CheckedConnection(std::move(channel), socket, this, table_);
  }
  bool ShallRead(orb::Connection* connection) override {
    return table_->Readable(static_cast<CheckedConnection*>(connection));
  }

 private:
  std::shared_ptr<ConnectionTable> table_;
};

class CheckedAddress : public omni::tcpAddress {
 public:
  explicit CheckedAddress(const IIOP::Address& address) : tcpAddress(address), address_(address) {}

  omni::giopAddress* duplicate() const override { return new CheckedAddress(address_); }
  omni::giopAddress* duplicate(const char* host) const override {
    IIOP::Address address;
    address.host = host;
    address.port = address_.port;
    return new CheckedAddress(address);
  }
  omni::giopActiveConnection* Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                      CORBA::Boolean& timed_out) const override {
    if (address_.port == 0) return nullptr;
    const omni::SocketHandle_t socket =
        omni::tcpSocket::Connect(address_.host, address_.port, deadline, flags, timed_out);
    return socket < 0 ? nullptr : new CheckedActiveConnection(nullptr, socket);
  }

 private:
  IIOP::Address address_;
};

class CheckedTransport : public omni::tcpTransportImpl {
 public:
  explicit CheckedTransport(std::size_t connections) : connections_(connections) {}

  omni::giopEndpoint* toEndpoint(const char* address) override {
    return isValid(address) ? new CheckedEndpoint(address, nullptr, connections_) : nullptr;
  }
  omni::giopAddress* toAddress(const char* text) override {
    IIOP::Address address;
    return parseAddress(text, address) ? new CheckedAddress(address) : nullptr;
  }

 private:
  std::size_t connections_;
};

class CheckedTlsTransport : public orb::TlsTransport {
 public:
  CheckedTlsTransport(std::shared_ptr<const orb::TlsContext> context, std::size_t connections)
      : TlsTransport(std::move(context)), connections_(connections) {}

  omni::giopEndpoint* toEndpoint(const char* address) override {
    return isValid(address) ? new CheckedEndpoint(address, context(), connections_) : nullptr;
  }
  omni::giopActiveConnection* MakeConnection(int socket,
                                             std::unique_ptr<orb::TlsChannel> channel) override {
    return new CheckedActiveConnection(std::move(channel), socket);
  }

 private:
  std::size_t connections_;
};

}  // namespace

std::unique_ptr<omni::giopTransportImpl> MakeCheckedTlsTransport(
    std::shared_ptr<const orb::TlsContext> context, std::size_t connections) {
  return std::make_unique<CheckedTlsTransport>(std::move(context), connections);
}

void InstallCheckedTransport(std::size_t connections) {
  // omniORB takes the first transport of a name; its own must give the name up.
  omni::giopTransportImpl* const plain = omni::giopTransportImpl::str2Transport("giop:tcp:h:1");
  GSV_CHECK(plain != nullptr);
  plain->type = "giop:unchecked-tcp";
  static CheckedTransport checked(connections);
}

}  // namespace gsv::broker
