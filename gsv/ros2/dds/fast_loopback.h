// A UDP transport of Fast DDS that stays on this machine, but also reaches participants of this
// machine that use the network.
//
// The sockets are bound to 127.0.0.1. Participants of this machine that announce a network address
// also listen at 127.0.0.1, so this transport sends their data there. Fast DDS without this
// transport cannot stay on this machine and still reach these participants. If its only interface
// is 127.0.0.1, it ignores participants with default settings. If it uses all interfaces, anybody
// on the network can send to it.
#pragma once

#include <cstdint>
#include <memory>

#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

namespace gsv::ros2::dds {

// The requested buffer of a socket, in bytes, with space for bursts of commands and requests. Linux
// gives at most net.core.rmem_max.
inline constexpr std::uint32_t kSocketBuffer = 4 << 20;

std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> LoopbackTransport(
    std::uint32_t max_peers);

// The peer address of participants on this machine that wait for multicast, as Cyclone DDS does
// with default settings. Announcements to this peer are multicast on loopback.
eprosima::fastrtps::rtps::Locator_t LocalGroup(std::uint32_t domain);

}  // namespace gsv::ros2::dds
