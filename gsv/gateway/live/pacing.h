// How often something is sent: at most at a rate, evenly, whatever the jitter of those who ask.
#pragma once

#include <chrono>
#include <cstdint>

namespace gsv::gateway {

using WallTime = std::chrono::steady_clock::time_point;

class Pacing {
 public:
  explicit Pacing(double rate)  // Hz, > 0
      : interval_(std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate))) {}

  // Somewhat early is due as well: else a round that comes a microsecond early would lose a turn.
  // The mean rate does not exceed the one given, since what came early counts as on time.
  bool IsDue(WallTime now) const { return now + interval_ / 4 >= next_; }
  void Done(WallTime now) { next_ = (now - next_ > interval_ ? now : next_) + interval_; }

 private:
  std::chrono::nanoseconds interval_;
  WallTime next_{};
};

}  // namespace gsv::gateway
