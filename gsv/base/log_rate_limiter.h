// How many lines a log may write: a bucket of lines that fills at a steady rate (a token bucket).
//
// Time comes from outside, so that the outcome is a function of what is asked.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gsv::base {

class LogRateLimiter {
 public:
  using Time = std::chrono::nanoseconds;  // since some instant

  // Fifty seconds' worth may be written at once.
  explicit LogRateLimiter(std::size_t lines_per_second)
      : rate_(static_cast<double>(lines_per_second)), capacity_(50 * rate_), left_(capacity_) {}

  // Whether a line may be written now.
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

  // How many were refused since this was last asked.
  std::uint64_t TakeSuppressed() { return std::exchange(suppressed_, 0); }

 private:
  double rate_, capacity_, left_;
  Time last_{};
  bool has_begun_ = false;
  std::uint64_t suppressed_ = 0;
};

}  // namespace gsv::base
