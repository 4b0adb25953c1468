// The robots whose sensors viewers have requested beyond those that the stream advertises.
//
// Threads  Want() and has_requests() from any; the others from one thread.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <set>
#include <string>

#include "gsv/base/mutex.h"

namespace gsv::gateway {

inline constexpr std::size_t kMaxWantedRobots = 100;

class WantedRobots {
 public:
  void Want(const std::string& robot);
  bool has_requests() const;

  // Takes the requests since the last call. Returns false if there were none.
  bool TakeRequests();
  // If there are too many robots, evicts those that are not `heard` (called only then), the oldest
  // request first. Returns the evicted robots.
  std::set<std::string> EvictUnheard(const std::function<std::set<std::string>()>& heard);
  bool Contains(const std::string& robot) const { return wanted_.contains(robot); }

 private:
  mutable base::Mutex mutex_;
  std::set<std::string> requests_ GSV_GUARDED_BY(mutex_);
  // Used by the thread that takes the requests.
  std::set<std::string> wanted_;
  std::list<std::string> in_order_;  // the robots in the order of requests
};

}  // namespace gsv::gateway
