// A UDP transport of Fast DDS that stays on this machine, but also reaches participants on this
// machine that use the network.
//
// Its sockets are bound to 127.0.0.1. A participant of this machine that announces the address of a network
// interface is sent to at 127.0.0.1, where it listens as well. Fast DDS alone offers one or the other: with
// 127.0.0.1 as only interface it ignores participants with default settings. Without that list anybody on
// the network can send to it.
#pragma once

#include <cstdint>
#include <memory>

#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

namespace gsv::ros2::dds {

// Bytes that sockets ask for, so that bursts of commands and requests find room. Linux gives at most net.core.rmem_max.
inline constexpr std::uint32_t kSocketBuffer = 4 << 20;

std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> LoopbackTransport(
    std::uint32_t max_peers);

// A peer for participants on this machine that wait for multicast, as Cyclone DDS does with default
// settings. Announcements to this peer are multicast on loopback.
eprosima::fastrtps::rtps::Locator_t LocalGroup(std::uint32_t domain);

}  // namespace gsv::ros2::dds
