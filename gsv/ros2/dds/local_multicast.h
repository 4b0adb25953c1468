// Multicast on the loopback interface only. The datagrams reach programs that joined the group on
// any interface.
//
// Linux delivers a datagram to each socket that is bound to the port and has joined any group
// (IP_MULTICAST_ALL of ip(7)). The condition is that some program has joined this group on
// loopback. LocalMulticast itself joins the group on loopback to satisfy the condition.
//
// This is how GSV finds participants that wait for a multicast announcement, such as those of
// Cyclone DDS with default settings.
//
// Threads  any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gsv::ros2::dds {

class LocalMulticast {
 public:
  // `group` is a dotted IPv4 address. If loopback does not allow multicast, nothing is sent.
  explicit LocalMulticast(const char* group);
  ~LocalMulticast();
  LocalMulticast(const LocalMulticast&) = delete;
  LocalMulticast& operator=(const LocalMulticast&) = delete;

  // Sends one datagram. Delivery is not guaranteed.
  void Send(std::span<const std::byte> datagram, std::uint16_t port) const;

 private:
  int socket_ = -1;          // -1 if there is no socket
  std::uint32_t group_ = 0;  // IPv4 address of the group, in network byte order
};

}  // namespace gsv::ros2::dds
