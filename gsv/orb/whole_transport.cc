#include "gsv/orb/whole_transport.h"

#include <cstring>
#include <mutex>

#include <fcntl.h>

// Each of omniORB's own headers needs those before it.
// clang-format off
#include <omniORB4/giopEndpoint.h>
#include <tcpSocket.h>
#include <SocketCollection.h>
#include <omniORB4/tcpConnection.h>
#include <omniORB4/tcpAddress.h>
#include <omniORB4/tcpEndpoint.h>
#include <omniORB4/tcpTransportImpl.h>
#include <omniORB4/unixConnection.h>
#include <omniORB4/unixAddress.h>
#include <omniORB4/unixEndpoint.h>
#include <omniORB4/unixTransportImpl.h>
// clang-format on

#include "gsv/base/check.h"

namespace gsv::orb {
namespace {

std::mutex limits_mutex;
MessageLimits limits_of_all;

omni::giopConnection* MakeWhole(int socket, omni::tcpEndpoint* endpoint, const char* /*address*/) {
  return new WholeMessages<omni::tcpConnection>(CurrentMessageLimits(), socket, endpoint);
}

omni::giopConnection* MakeWhole(int socket, omni::unixEndpoint* endpoint, const char* address) {
  const char* const file = address + std::strlen("giop:unix:");
  return new WholeMessages<omni::unixConnection>(CurrentMessageLimits(), socket, endpoint, file,
                                                 CORBA::Boolean(false));
}

template <typename Endpoint, typename Connection>
class WholeEndpoint final : public Endpoint {
 public:
  using Endpoint::Endpoint;

  // A connection as omniORB makes it gives its socket to one of ours.
  omni::giopConnection* AcceptAndMonitor(omni::giopConnection::notifyReadable_t readable,
                                         void* cookie) override {
    while (omni::giopConnection* const plain = Endpoint::AcceptAndMonitor(readable, cookie)) {
      const int socket = fcntl(static_cast<Connection*>(plain)->handle(), F_DUPFD_CLOEXEC, 0);
      plain->decrRefCount(true);
      if (socket >= 0) return MakeWhole(socket, this, this->address());
    }
    return nullptr;
  }
};

template <typename Transport, typename Endpoint>
class WholeTransport final : public Transport {
 public:
  omni::giopEndpoint* toEndpoint(const char* address) override {
    return this->isValid(address) ? new Endpoint(address) : nullptr;
  }
};

// omniORB takes the first transport of a name; its own must give the name up.
void GiveUpName(const char* address, const char* name) {
  omni::giopTransportImpl* const plain = omni::giopTransportImpl::str2Transport(address);
  GSV_CHECK(plain != nullptr);
  plain->type = name;
}

}  // namespace

void InstallWholeTransports(const MessageLimits& limits) {
  {
    const std::lock_guard lock(limits_mutex);
    limits_of_all = limits;
  }
  static std::once_flag installed;
  std::call_once(installed, [] {
    GiveUpName("giop:tcp:h:1", "giop:plain-tcp");
    GiveUpName("giop:unix:/f", "giop:plain-unix");
    using TcpEndpoint = WholeEndpoint<omni::tcpEndpoint, omni::tcpConnection>;
    using UnixEndpoint = WholeEndpoint<omni::unixEndpoint, omni::unixConnection>;
    static WholeTransport<omni::tcpTransportImpl, TcpEndpoint> tcp;
    static WholeTransport<omni::unixTransportImpl, UnixEndpoint> local;
  });
}

MessageLimits CurrentMessageLimits() {
  const std::lock_guard lock(limits_mutex);
  return limits_of_all;
}

}  // namespace gsv::orb
