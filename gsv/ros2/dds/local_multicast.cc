#include "gsv/ros2/dds/local_multicast.h"

#include <arpa/inet.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "gsv/base/log.h"

namespace gsv::ros2::dds {
namespace {

sockaddr_in Address(std::uint32_t ip, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ip;
  address.sin_port = htons(port);
  return address;
}

// Makes the socket send to the group on loopback. Returns whether this succeeded.
bool StayOnLoopback(int socket, std::uint32_t group) {
  const sockaddr_in loopback = Address(htonl(INADDR_LOOPBACK), 0);
  ip_mreqn membership{};
  membership.imr_multiaddr.s_addr = group;
  membership.imr_address = loopback.sin_addr;
  membership.imr_ifindex = static_cast<int>(if_nametoindex("lo"));
  return bind(socket, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback) == 0 &&
         setsockopt(socket, IPPROTO_IP, IP_MULTICAST_IF, &membership, sizeof membership) == 0 &&
         setsockopt(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0;
}

}  // namespace

LocalMulticast::LocalMulticast(const char* group)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), group_(inet_addr(group)) {
  if (socket_ < 0 || StayOnLoopback(socket_, group_)) return;
  spdlog::warn(
      "this machine has no multicast on loopback ({}): ROS 2 nodes that wait for it do not find "
      "gsv. Set "
      "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST for them",
      std::strerror(errno));
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
}

LocalMulticast::~LocalMulticast() {
  if (socket_ >= 0) close(socket_);
}

void LocalMulticast::Send(std::span<const std::byte> datagram, std::uint16_t port) const {
  if (socket_ < 0) return;
  const sockaddr_in to = Address(group_, port);
  (void)sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(&to), sizeof to);
}

}  // namespace gsv::ros2::dds
