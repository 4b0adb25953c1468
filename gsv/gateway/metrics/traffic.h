// Counters of a server's connections.
//
// Threads  any.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace gsv::gateway::metrics {

// Counters of a server's connections.
struct Traffic {
  std::atomic<std::uint64_t> connections{0};      // open connections
  std::atomic<std::uint64_t> viewers{0};          // open WebSockets
  std::atomic<std::uint64_t> sent_bytes{0};       // HTTP responses and messages to viewers
  std::atomic<std::uint64_t> dropped_updates{0};  // updates that were dropped for slow viewers
  std::atomic<std::uint64_t> turned_away{0};      // refused connections over the limit
  // HTTP responses by the first digit of their status.
  std::array<std::atomic<std::uint64_t>, 6> answers{};
};

}  // namespace gsv::gateway::metrics
