// Pacing limits the rate of messages to a mean rate, even if the caller polls irregularly.
#pragma once

#include <chrono>
#include <cstdint>

namespace gsv::gateway {

using WallTime = std::chrono::steady_clock::time_point;

// Limits the rate of messages.
class Pacing {
 public:
  explicit Pacing(double rate) { SetRate(rate); }  // `rate` is in Hz, > 0

  // The new rate applies from the next Done() on.
  void SetRate(double rate) {
    interval_ = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate));
  }

  // Returns whether it is time to send. A slightly early call counts as on time, so that jitter
  // does not skip a message. The mean rate does not exceed the given rate.
  bool IsDue(WallTime now) const { return now + interval_ / 4 >= next_; }
  // Call this after each sent message.
  void Done(WallTime now) { next_ = (now - next_ > interval_ ? now : next_) + interval_; }

 private:
  std::chrono::nanoseconds interval_{};  // time between two messages
  WallTime next_{};                      // time at which the next message is due
};

}  // namespace gsv::gateway
