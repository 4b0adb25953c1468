// A UDP transport of Fast DDS that stays on this machine, but also reaches participants of this
// machine that use the network.
//
// The sockets are bound to 127.0.0.1. Participants of this machine that announce a network address
// also listen at 127.0.0.1, so this transport sends their data there. Without this transport, Fast
// DDS cannot reach these participants and stay on this machine at the same time. If Fast DDS uses
// only the interface 127.0.0.1, it ignores participants with default settings. If Fast DDS uses all
// interfaces, everybody on the network can send data to it.
#pragma once

#include <cstdint>
#include <memory>

#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

namespace gsv::ros2::dds {

// The buffer size that is requested for a socket, in bytes. It has space for bursts of commands and
// requests. The actual size is at most net.core.rmem_max of Linux.
inline constexpr std::uint32_t kSocketBuffer = 4 << 20;

// Makes the transport. For discovery, the participant announces itself at the ports of the
// participant indices 0 to `max_peers` - 1.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> LoopbackTransport(
    std::uint32_t max_peers);

// The peer address for participants on this machine that wait for multicast, such as those of
// Cyclone DDS with default settings. Announcements to this peer are sent by multicast on loopback.
eprosima::fastrtps::rtps::Locator_t LocalGroup(std::uint32_t domain);

}  // namespace gsv::ros2::dds
