// The requests that were answered lately: one that comes again, round a circle of traders, is told
// from a new one.
//
// Bounded in number and in time: the oldest are forgotten first.
//
// Threads  every member may be called at any time.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace gsv::broker {

class RequestHistory {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  RequestHistory(std::size_t requests, std::chrono::nanoseconds lifetime,
                 Clock clock = std::chrono::steady_clock::now);

  // True the first time that this request comes.
  bool Remember(const std::string& id);

 private:
  using Remembered = std::set<std::string>;

  void ForgetOldest();

  const std::size_t requests_;
  const std::chrono::nanoseconds lifetime_;
  const Clock clock_;
  std::mutex mutex_;  // guards all that follows
  Remembered ids_;
  std::deque<std::pair<std::chrono::steady_clock::time_point, Remembered::iterator>> by_age_;
};

}  // namespace gsv::broker
