// Converts simulated time to the time in messages.
//
// Range  times from 0 to 2^31 s, because ROS's seconds have 32 bits.
#pragma once

#include "gsv/base/sim_time.h"
#include "gsv/messages/builtin_interfaces.h"

namespace gsv::messages {

inline builtin_interfaces::Time ToMessage(base::SimTime time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return {static_cast<std::int32_t>(time.count() / kSecond),
          static_cast<std::uint32_t>(time.count() % kSecond)};
}

inline base::SimTime ToSimTime(const builtin_interfaces::Time& time) {
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nanosec);
}

}  // namespace gsv::messages
