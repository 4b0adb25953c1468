// How long behaviours in other processes have to answer the calls that end their runs.
//
// Threads  any.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>

namespace gsv::services {

// One for all behaviours of a process. Normally a call may take as long as any other. After
// Hurry(), when the process shall end, all calls together have what is left of a second: a
// behaviour that never returns does not hold up the end.
class StopTimeout {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kNormal{10'000};
  static constexpr std::chrono::milliseconds kShortened{1'000};
  static constexpr std::chrono::milliseconds kMin{20};  // for those whose turn comes later

  void Shorten() { until_ = Clock::now() + kShortened; }
  bool is_shortened() const { return until_.load() != Clock::time_point::max(); }
  // For a call that begins now.
  std::chrono::milliseconds limit() const {
    const Clock::time_point until = until_;
    if (until == Clock::time_point::max()) return kNormal;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    return std::clamp(left, kMin, kShortened);
  }

 private:
  std::atomic<Clock::time_point> until_{Clock::time_point::max()};
};

}  // namespace gsv::services
