// Remembers recently answered requests. So a request that returns through a cycle of traders is
// recognised.
//
// The number of requests and their age are limited. The oldest requests are removed first.
//
// Threads  every member may be called at any time.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "gsv/base/mutex.h"

namespace gsv::broker {

class RequestHistory {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  RequestHistory(std::size_t requests, std::chrono::nanoseconds lifetime,
                 Clock clock = std::chrono::steady_clock::now);

  // Remembers the request. Returns true if it was not remembered before.
  bool Remember(const std::string& id);

 private:
  using Remembered = std::set<std::string>;  // ids of requests

  // Forgets the request that was remembered first of all.
  void ForgetOldest() GSV_REQUIRES(mutex_);

  const std::size_t requests_;               // maximum number of remembered requests
  const std::chrono::nanoseconds lifetime_;  // how long an id is remembered
  const Clock clock_;
  base::Mutex mutex_;
  Remembered ids_ GSV_GUARDED_BY(mutex_);  // ids of the remembered requests
  std::deque<std::pair<std::chrono::steady_clock::time_point, Remembered::iterator>> by_age_
      GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::broker
