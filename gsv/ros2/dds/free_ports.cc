#include "gsv/ros2/dds/free_ports.h"

#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

namespace gsv::ros2::dds {
namespace {

constexpr std::uint32_t kMaxPort = 65535;

bool IsPortFree(std::uint32_t port, bool on_loopback) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(on_loopback ? INADDR_LOOPBACK : INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool is_free =
      bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(socket);
  return is_free;
}

}  // namespace

int FreeIndex(std::uint32_t domain, bool on_loopback, const std::set<int>& taken) {
  for (int index = 0; index < kMaxParticipants; ++index) {
    const std::uint32_t first = 7410 + 250 * domain + 2 * static_cast<std::uint32_t>(index);
    if (first + 1 > kMaxPort) return -1;
    if (taken.contains(index)) continue;
    if (IsPortFree(first, on_loopback) && IsPortFree(first + 1, on_loopback)) return index;
  }
  return -1;
}

bool IsLoopbackUp() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  const bool is_known = socket >= 0 && ioctl(socket, SIOCGIFFLAGS, &request) == 0;
  if (socket >= 0) close(socket);
  return !is_known || (request.ifr_flags & IFF_UP) != 0;
}

}  // namespace gsv::ros2::dds
