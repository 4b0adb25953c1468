// What a server's connections have done, counted.
//
// Threads  any.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace gsv::gateway::metrics {

struct Traffic {
  std::atomic<std::uint64_t> connections{0};            // that are open
  std::atomic<std::uint64_t> viewers{0};                // WebSockets that are open
  std::atomic<std::uint64_t> sent_bytes{0};             // HTTP answers and messages to viewers
  std::atomic<std::uint64_t> dropped_updates{0};        // that viewers were too slow for
  std::atomic<std::uint64_t> turned_away{0};            // connections, as there were too many
  std::array<std::atomic<std::uint64_t>, 6> answers{};  // HTTP, by the first digit of their status
};

}  // namespace gsv::gateway::metrics
