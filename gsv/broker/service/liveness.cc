#include "gsv/broker/service/liveness.h"

#include <cerrno>

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "gsv/broker/trader/service_reference.h"

namespace gsv::broker {
namespace {

bool IsConnectionRefused(const addrinfo& address, int timeout_ms) {
  const int socket =
      ::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, IPPROTO_TCP);
  if (socket < 0) return false;
  int error = connect(socket, address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
  if (error == EINPROGRESS) {
    pollfd wait{.fd = socket, .events = POLLOUT, .revents = 0};
    socklen_t size = sizeof error;
    if (poll(&wait, 1, timeout_ms) != 1) {
      error = ETIMEDOUT;
    } else if (getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) != 0) {
      error = errno;
    }
  }
  close(socket);
  return error == ECONNREFUSED;
}

// omniORB reports all failures of a connection with the same exception, so this function connects
// itself.
bool RefusesConnections(const std::string& reference, std::chrono::milliseconds timeout) {
  const auto service = ReadReference(reference);
  if (!service || service->host.empty()) return false;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(service->port);
  if (getaddrinfo(service->host.c_str(), port.c_str(), &hints, &found) != 0) return false;
  const bool refused = IsConnectionRefused(*found, static_cast<int>(timeout.count()));
  freeaddrinfo(found);
  return refused;
}

}  // namespace

Liveness CheckLiveness(CORBA::ORB_ptr orb, const std::string& reference,
                       std::chrono::milliseconds timeout) {
  try {
    const CORBA::Object_var service = orb->string_to_object(reference.c_str());
    omniORB::setClientCallTimeout(service, static_cast<unsigned long>(timeout.count()));
    return service->_non_existent() ? Liveness::kGone : Liveness::kAlive;
  } catch (const CORBA::OBJECT_NOT_EXIST&) {
    return Liveness::kGone;
  } catch (const CORBA::TRANSIENT&) {
    return RefusesConnections(reference, timeout) ? Liveness::kGone : Liveness::kSilent;
  } catch (const CORBA::COMM_FAILURE&) {
    return Liveness::kSilent;
  } catch (const CORBA::TIMEOUT&) {
    return Liveness::kSilent;
  } catch (const CORBA::Exception&) {
    return Liveness::kAlive;
  }
}

}  // namespace gsv::broker
