#include "gsv/orb/orb.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "gsv/orb/corba_access.h"
#include "gsv/orb/local_socket.h"
#include "gsv/orb/transport/connection_policy.h"
#include "gsv/orb/transport/object_addresses.h"

namespace gsv::orb {
namespace {

class RequestCheck final : public ConnectionHooks {
 public:
  using Check = void (*)(std::string& message);
  explicit RequestCheck(Check check) : check_(check) {}

  void OnMessage(std::string& message) override { check_(message); }

 private:
  const Check check_;
};

ConnectionPolicy PolicyOf(const OrbOptions& options) {
  ConnectionPolicy policy;
  policy.limits = {options.max_message_bytes, options.message_time};
  if (options.check_request != nullptr) {
    policy.accepted = [check = options.check_request](ConnectionControl&) {
      return std::make_unique<RequestCheck>(check);
    };
  }
  return policy;
}

}  // namespace

base::Result<CORBA::ORB_var> StartOrb(const OrbOptions& options) {
  const auto access = PrepareAccess(options.host, options.port);
  if (!access) return base::Fail(access.error());
  const std::string max_message = std::to_string(options.max_message_bytes);
  const std::string message_time =
      std::to_string(std::chrono::milliseconds(options.message_time).count());
  const std::string call_timeout = std::to_string(options.call_timeout.count());
  // The time limit for opening a connection. If a call has to open one, this limit replaces the
  // call's limit.
  const std::string connect_timeout =
      std::to_string(std::min<std::int64_t>(options.call_timeout.count(), 5000));
  const std::string connections = std::to_string(options.max_connections_per_server);
  std::string local_endpoint;
  if (options.local_socket) {
    if (const auto socket = NewLocalSocket()) local_endpoint = "giop:unix:" + socket->native();
  }
  const char* settings[][2] = {
      {"endPoint", access->endpoint.c_str()},
      {"clientTransportRule", access->client_rules[0]},
      {"clientTransportRule", access->client_rules[1]},
      {"giopMaxMsgSize", max_message.c_str()},
      {"clientCallTimeOutPeriod", call_timeout.c_str()},
      {"clientConnectTimeOutPeriod", connect_timeout.c_str()},
      // A server drops a message that has not arrived completely after this time.
      {"serverCallTimeOutPeriod", message_time.c_str()},
      // A server closes an idle connection after 180 s. Clients close it earlier, after 60 s.
      {"inConScanPeriod", "180"},
      {"outConScanPeriod", "60"},
      {"scanGranularity", "5"},
      {"threadPerConnectionPolicy", "1"},
      {"maxServerThreadPerConnection", "16"},
      {"maxGIOPConnectionPerServer", connections.c_str()},
      {"oneCallPerConnection", "1"},
      {"supportPerThreadTimeOut", "1"},
      {"lcdMode", "0"},
      // Without strict mode, omniORB skips surplus bytes after a request's arguments. In strict
      // mode, omniORB 4.2.5 would close the connection and leak about 9 kB.
      {"strictIIOP", "0"},
      {"traceLevel", "0"},
      {"unixTransportPermission", "0600"},
      // if there is no local endpoint, this null ends the list here
      {local_endpoint.empty() ? nullptr : "endPoint", local_endpoint.c_str()},
      {nullptr, nullptr},
  };
  SetConnectionPolicy(PolicyOf(options));
  try {
    int argc = 0;
    CORBA::ORB_var orb = CORBA::ORB_init(argc, nullptr, "omniORB4", settings);
    PortableServer::POA_var poa = RootPoa(orb);
    PortableServer::POAManager_var manager = poa->the_POAManager();
    manager->activate();
    return orb;
  } catch (const CORBA::Exception& exception) {
    const std::string where = options.host + ":" + std::to_string(options.port);
    return base::Fail(
        base::ErrorCode::kUnavailable,
        options.port > 0
            ? "the port is in use or not allowed; choose another, or 0 for any"
            : std::string("the object request broker did not start (") + exception._name() + ")",
        where);
  }
}

base::Result<CORBA::ORB_var> CallingOrb() {
  const auto access = PrepareAccess("127.0.0.1", 0);
  if (!access) return base::Fail(access.error());
  const char* settings[][2] = {{"clientTransportRule", access->client_rules[0]},
                               {"clientTransportRule", access->client_rules[1]},
                               {nullptr, nullptr}};
  try {
    int no_arguments = 0;
    return CORBA::ORB_var(CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings));
  } catch (const CORBA::Exception& exception) {
    return base::Fail(
        base::ErrorCode::kUnavailable,
        std::string("the object request broker did not start (") + exception._name() + ")");
  }
}

PortableServer::POA_ptr RootPoa(CORBA::ORB_ptr orb) {
  CORBA::Object_var object = orb->resolve_initial_references("RootPOA");
  return PortableServer::POA::_narrow(object);
}

base::Result<std::string> LocalAddressTowards(const std::string& host) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), "9", &hints, &found) != 0 || found == nullptr) {
    return base::Fail(base::ErrorCode::kUnavailable, "there is no host of this name", host);
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
  // connect() on a datagram socket sends nothing. It only selects the route, and so the local
  // address.
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in local{};
  socklen_t length = sizeof local;
  const bool ok = descriptor >= 0 && connect(descriptor, found->ai_addr, found->ai_addrlen) == 0 &&
                  getsockname(descriptor, reinterpret_cast<sockaddr*>(&local), &length) == 0;
  if (descriptor >= 0) close(descriptor);
  std::array<char, INET_ADDRSTRLEN> text{};
  if (!ok || inet_ntop(AF_INET, &local.sin_addr, text.data(), text.size()) == nullptr) {
    return base::Fail(base::ErrorCode::kUnavailable, "there is no route to that host", host);
  }
  return std::string(text.data());
}

std::string AddressOf(CORBA::Object_ptr object) {
  for (const std::string& address : AddressesIn(object)) {
    for (const std::string_view scheme : {"giop:tcp:", "giop:ssl:"}) {
      if (address.starts_with(scheme)) return address.substr(scheme.size());
    }
  }
  return {};
}

void LimitCalls(CORBA::Object_ptr object, std::chrono::milliseconds timeout) {
  omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(timeout.count()));
}

}  // namespace gsv::orb
