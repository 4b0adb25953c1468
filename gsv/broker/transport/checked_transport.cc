#include "gsv/broker/transport/checked_transport.h"

#include <atomic>
#include <cerrno>
#include <memory>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

#include "gsv/base/check.h"
#include "gsv/broker/transport/checked_connection.h"

// They need the connection's.
// clang-format off
#include <omniORB4/tcpAddress.h>
#include <omniORB4/tcpEndpoint.h>
#include <omniORB4/tcpTransportImpl.h>
// clang-format on

namespace gsv::broker {
namespace {

class CheckedEndpoint : public omni::tcpEndpoint {
 public:
  CheckedEndpoint(const char* address, std::size_t connections)
      : tcpEndpoint(address), table_(std::make_shared<ConnectionTable>(connections)) {}

  omni::giopConnection* AcceptAndMonitor(omni::giopConnection::notifyReadable_t readable,
                                         void* cookie) override {
    readable_ = readable;
    cookie_ = cookie;
    setSelectable(1, false);
    while (!poked_) {
      accepted_ = -1;
      if (!Select()) break;
      if (accepted_ >= 0) return new CheckedConnection(accepted_, this, table_);
    }
    return nullptr;
  }

  void Poke() override {
    poked_ = true;
    tcpEndpoint::Poke();
  }

 protected:
  CORBA::Boolean notifyReadable(omni::SocketHolder* holder) override {
    if (holder == static_cast<omni::SocketHolder*>(this)) {
      accepted_ = accept4(pd_socket, nullptr, nullptr, SOCK_CLOEXEC);
      if (accepted_ < 0 && errno == EBADF) return false;
      setSelectable(1, false);
      return true;
    }
    auto* const connection = static_cast<CheckedConnection*>(holder);
    if (table_->Readable(connection)) readable_(cookie_, connection);
    return true;
  }

 private:
  std::shared_ptr<ConnectionTable> table_;
  int accepted_ = -1;
  omni::giopConnection::notifyReadable_t readable_ = nullptr;
  void* cookie_ = nullptr;
  std::atomic<bool> poked_ = false;  // by another thread
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
    return socket < 0 ? nullptr : new CheckedActiveConnection(socket);
  }

 private:
  IIOP::Address address_;
};

class CheckedTransport : public omni::tcpTransportImpl {
 public:
  explicit CheckedTransport(std::size_t connections) : connections_(connections) {}

  omni::giopEndpoint* toEndpoint(const char* address) override {
    return isValid(address) ? new CheckedEndpoint(address, connections_) : nullptr;
  }
  omni::giopAddress* toAddress(const char* text) override {
    IIOP::Address address;
    return parseAddress(text, address) ? new CheckedAddress(address) : nullptr;
  }

 private:
  std::size_t connections_;
};

}  // namespace

void InstallCheckedTransport(std::size_t connections) {
  // omniORB takes the first transport of a name; its own must give the name up.
  omni::giopTransportImpl* const plain = omni::giopTransportImpl::str2Transport("giop:tcp:h:1");
  GSV_CHECK(plain != nullptr);
  plain->type = "giop:unchecked-tcp";
  static CheckedTransport checked(connections);
}

}  // namespace gsv::broker
