// Limits the number of lines that a log writes, with a token bucket that fills at a constant rate.
//
// The caller passes the time, so that tests need no clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gsv::base {

class LogRateLimiter {
 public:
  using Time = std::chrono::nanoseconds;  // time since any fixed instant

  // A burst may have as many lines as the limit allows in fifty seconds.
  explicit LogRateLimiter(std::size_t lines_per_second)
      : rate_(static_cast<double>(lines_per_second)), capacity_(50 * rate_), left_(capacity_) {}

  // Takes a token for one line. Returns false if no token is left. Then the line must not be
  // written.
  bool Take(Time now) {
    const double seconds = std::chrono::duration<double>(now - last_).count();
    if (has_begun_ && seconds > 0) left_ = left_ + seconds * rate_;
    if (left_ > capacity_) left_ = capacity_;
    last_ = now;
    has_begun_ = true;
    if (left_ < 1) {
      ++suppressed_;
      return false;
    }
    left_ -= 1;
    return true;
  }

  // The number of lines that Take() has refused since the last call of this function.
  std::uint64_t TakeSuppressed() { return std::exchange(suppressed_, 0); }

 private:
  // The bucket: tokens per second, maximum number of tokens, and present number of tokens.
  double rate_, capacity_, left_;
  Time last_{};                   // time of the last Take()
  bool has_begun_ = false;        // whether Take() has been called
  std::uint64_t suppressed_ = 0;  // see TakeSuppressed()
};

}  // namespace gsv::base
