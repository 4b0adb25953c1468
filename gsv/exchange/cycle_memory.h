// The layout of the memory by which a behaviour exchanges its control cycles with a simulation on
// the same host. The memory replaces the calls Clock::exchange() and BatchClock::sleep_and_read().
// The memory carries only successful cycles. After an error, or if no answer arrives in time, the
// client repeats the cycle with a call (docs/adr/111-cycles-by-shared-memory.md).
//
// The memory is a shared file. The file begins with a Bell. From the offset kSlotSize on, it
// contains one CycleSlot for each clock. A client maps the bell and its own slot. Each side first
// copies the data of the other side, and then checks the copy. A client that writes arbitrary bytes
// into its slot harms only its own cycles. With arbitrary bytes in the bell, it can delay each step
// in lockstep by up to 20 ms.
//
// Threads  a member that is not atomic belongs to one side at a time, see CycleState.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "gsv/exchange/futex.h"

namespace gsv::exchange {

// The bell wakes the stepping thread. All clients of a simulation share it.
struct Bell {
  Word rings;                        // changes whenever the stepping thread must check the slots
  Word sleepers;                     // number of threads of the simulator that sleep on `rings`
  Word posted;                       // number of requests that clients have posted
  Word wanted;                       // a client rings if `posted` has reached this number
  std::atomic<std::int64_t> now_ns;  // simulated time
  // The key that share_memory() returns. If a client finds another key here, it has opened a wrong
  // file and does not use it.
  std::atomic<std::uint64_t> key;
};

// Returns whether `posted` has reached `wanted`. Both wrap around.
inline bool HasReached(std::uint32_t posted, std::uint32_t wanted) {
  return static_cast<std::int32_t>(posted - wanted) >= 0;
}

// Wakes the stepping thread if it sleeps.
inline void Ring(Bell& bell) {
  bell.rings.fetch_add(1);
  if (bell.sleepers.load() > 0) FutexWake(bell.rings);
}

// The state of a slot. The word CycleSlot::state contains a state in its lowest kStateBits bits and
// the number of the request in the other bits. Each side changes the state by compare-and-swap
// (except to kClosed). So a late change that belongs to an earlier request fails.
enum class CycleState : std::uint32_t {
  kNew,       // no client uses the slot yet
  kIdle,      // the client may write a request
  kPosted,    // the simulation may read the request
  kTaken,     // the simulation has read the request and may write the answer
  kAnswered,  // the client may read the answer
  kRepeat,    // there is no answer; the client repeats this cycle by a call
  kClosed,    // the slot is not used any more; the client uses calls
};
// Number of bits of CycleSlot::state that contain the state.
constexpr std::uint32_t kStateBits = 3;
inline CycleState StateOf(std::uint32_t word) {
  return static_cast<CycleState>(word & ((1U << kStateBits) - 1));
}
inline std::uint32_t WithState(std::uint32_t word, CycleState state) {
  return (word >> kStateBits << kStateBits) | static_cast<std::uint32_t>(state);
}

// A request, see Clock::exchange() in idl/hardware.idl.
struct CycleRequest {
  // Cycle number of an exchange; 0 for sleep_and_read(), whose sensor names are in
  // CycleSlot::content.
  std::uint64_t cycle = 0;
  std::int64_t instant_ns = 0;                  // simulated time until which the caller waits
  double linear = 0, lateral = 0, angular = 0;  // m/s, m/s, rad/s
  std::uint32_t has_command = 0;                // 1 if the request contains a drive command, else 0
  std::uint32_t content_size = 0;               // bytes
};

// An answer, see Clock::exchange() and BatchClock::sleep_and_read() in idl/.
struct CycleAnswer {
  std::int64_t reached_ns = 0;   // simulated time of the answer
  std::uint32_t holds_time = 0;  // 1 if simulated time stands still until the next request, else 0
  std::uint32_t content_size = 0;  // bytes
};

constexpr std::size_t kSlotSize = std::size_t{64} << 10U;  // distance between two slots, bytes
constexpr std::size_t kContentSize = kSlotSize - 192;      // size of CycleSlot::content, bytes

// The memory by which one clock exchanges its cycles.
struct CycleSlot {
  alignas(64) Word state;  // a CycleState and a request number, see CycleState
  // Whether the command of the request was applied. Set before the state becomes kTaken.
  Word is_applied;
  alignas(64) CycleRequest request;
  alignas(64) CycleAnswer answer;
  // The sensor names of the request, or the readings of the answer (content.h).
  alignas(64) std::byte content[kContentSize];
};
static_assert(sizeof(CycleSlot) <= kSlotSize && std::is_standard_layout_v<CycleSlot>);
static_assert(sizeof(Bell) <= 4096);

}  // namespace gsv::exchange
