// An endpoint at which an ORB listens: a TCP port, with or without TLS, or a socket in the file
// system.
#pragma once

#include <algorithm>
#include <cerrno>
#include <memory>
#include <string_view>
#include <utility>

#include <sys/socket.h>

#include "gsv/orb/transport/listener.h"

namespace gsv::orb {

// `Base` is omni::tcpEndpoint or omni::unixEndpoint, which bind the socket and publish its address.
template <typename Base>
class Endpoint final : public Base {
 public:
  // `address`, "HOST:PORT" or a file, must outlive the endpoint. Without a context, the endpoint
  // does not use TLS.
  explicit Endpoint(const char* address, std::shared_ptr<const TlsContext> context = nullptr)
      : Base(address), listener_(*this, std::move(context)) {}

  const char* type() const override { return listener_.speaks_tls() ? "giop:ssl" : Base::type(); }

  CORBA::Boolean publish(const omni::orbServer::PublishSpecs& specifications,
                         CORBA::Boolean all_specifications, CORBA::Boolean all_endpoints,
                         omni::orbServer::EndpointList& published) override {
    if (!listener_.speaks_tls()) {
      return Base::publish(specifications, all_specifications, all_endpoints, published);
    }
    // Publishes the endpoint's own addresses, as omniORB does by default. A TLS endpoint has no
    // other addresses.
    const omni::orbServer::EndpointList& own = *this->addresses();
    const CORBA::ULong count =
        all_endpoints ? own.length() : std::min<CORBA::ULong>(own.length(), 1);
    for (CORBA::ULong i = 0; i < count; ++i) {
      omni::giopEndpoint::addToIOR(own[i]);
      published.length(published.length() + 1);
      published[published.length() - 1] = own[i];
    }
    return count > 0;
  }

  omni::giopConnection* AcceptAndMonitor(omni::giopConnection::notifyReadable_t readable,
                                         void* cookie) override {
    this->setSelectable(1, false);
    return listener_.Await(readable, cookie);
  }

  void Poke() override {
    listener_.Poke();
    Base::Poke();
  }

 protected:
  CORBA::Boolean notifyReadable(omni::SocketHolder* holder) override {
    if (holder != static_cast<omni::SocketHolder*>(this)) {
      listener_.Notify(holder);
      return true;
    }
    const int accepted = accept4(this->pd_socket, nullptr, nullptr, SOCK_CLOEXEC);
    if (accepted < 0 && errno == EBADF) return false;
    if (accepted >= 0) listener_.Accept(accepted, AddressesOf(accepted));
    this->setSelectable(1, false);
    return true;
  }

 private:
  ConnectionAddresses AddressesOf(int accepted) const {
    return std::string_view(type()) == "giop:unix" ? AddressesOfAcceptedLocal(this->address())
                                                   : AddressesOfTcp(accepted, type());
  }

  Listener listener_;
};

}  // namespace gsv::orb
