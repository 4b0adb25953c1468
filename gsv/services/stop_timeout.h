// The time limit of calls that end the runs of behaviours in other processes.
//
// Threads  any.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>

namespace gsv::services {

// All behaviours of a process share one StopTimeout. Normally each call has the normal limit. When
// the process ends, it calls Shorten(). From then on, all calls together have one second, so that a
// behaviour that does not return cannot delay the end of the process.
class StopTimeout {
 public:
  using Clock = std::chrono::steady_clock;
  // limit of each call before Shorten()
  static constexpr std::chrono::milliseconds kNormal{10'000};
  // limit of all calls together after Shorten()
  static constexpr std::chrono::milliseconds kShortened{1'000};
  static constexpr std::chrono::milliseconds kMin{20};  // the minimum limit of a call

  // Starts the shortened limit, see above.
  void Shorten() { until_ = Clock::now() + kShortened; }
  bool is_shortened() const { return until_.load() != Clock::time_point::max(); }
  // Returns the limit for a call that begins now.
  std::chrono::milliseconds limit() const {
    const Clock::time_point until = until_;
    if (until == Clock::time_point::max()) return kNormal;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    return std::clamp(left, kMin, kShortened);
  }

 private:
  // End of the shortened limit; max() before Shorten().
  std::atomic<Clock::time_point> until_{Clock::time_point::max()};
};

}  // namespace gsv::services
