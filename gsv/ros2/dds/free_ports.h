// Finds free UDP ports for a participant on all interfaces or on loopback.
//
// A domain has two unicast ports for each index of a participant (RTPS 2.3, 9.6.1.1).
#pragma once

#include <cstdint>
#include <set>

namespace gsv::ros2::dds {

inline constexpr int kMaxParticipants = 120;  // maximum per machine and domain; RTPS 2.3, 9.6.1.3

// Returns the lowest index that is not in `taken` and whose ports are free, on loopback or on all
// interfaces. Returns -1 if there is none.
int FreeIndex(std::uint32_t domain, bool on_loopback, const std::set<int>& taken);

// Whether this machine's loopback interface is switched on.
bool IsLoopbackUp();

}  // namespace gsv::ros2::dds
