// Waits on an atomic word that several processes may share, by Linux futexes.
//
// Threads  any.
#pragma once

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdint>
#include <ctime>
#include <optional>

namespace gsv::exchange {

using Word = std::atomic<std::uint32_t>;
static_assert(sizeof(Word) == 4 && Word::is_always_lock_free);

// Sleeps until FutexWake(), but only if the word still has `value`. May also return early. `until`
// is a time of the monotonic clock (std::chrono::steady_clock) since its epoch. Returns false if
// this time has passed.
inline bool FutexWait(Word& word, std::uint32_t value,
                      std::optional<std::chrono::nanoseconds> until = std::nullopt) {
  timespec time{};
  if (until) {
    time.tv_sec = static_cast<time_t>(until->count() / 1'000'000'000);
    time.tv_nsec = static_cast<long>(until->count() % 1'000'000'000);
  }
  const long result = syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAIT_BITSET,
                              value, until ? &time : nullptr, nullptr, FUTEX_BITSET_MATCH_ANY);
  return result == 0 || errno != ETIMEDOUT;
}

// Wakes all threads of all processes that wait on the word.
inline void FutexWake(Word& word) {
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAKE, INT_MAX, nullptr, nullptr,
          0);
}

}  // namespace gsv::exchange
