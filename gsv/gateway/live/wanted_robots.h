// WantedRobots stores the robots whose sensor topics viewers have requested. A stream advertises
// these topics even beyond its limit on topics.
//
// Threads  Want() and has_requests() from any; the other functions from one thread.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <set>
#include <string>

#include "gsv/base/mutex.h"

namespace gsv::gateway {

// The number of requested robots above which robots without subscribers are removed.
inline constexpr std::size_t kMaxWantedRobots = 100;

// The robots whose sensor topics viewers have requested.
class WantedRobots {
 public:
  // Requests the topics of a robot.
  void Want(const std::string& robot);
  // Whether robots were requested since the last TakeRequests().
  bool has_requests() const;

  // Processes the requests since the last call. Returns false if there were none.
  bool TakeRequests();
  // If there are too many robots, removes robots without subscribers, beginning with the robot
  // whose request is the oldest. Returns the removed robots. `subscribed` must return the robots
  // with subscribers. It is called only if there are too many robots.
  std::set<std::string> EvictUnsubscribed(const std::function<std::set<std::string>()>& subscribed);
  // Whether the topics of this robot were requested.
  bool Contains(const std::string& robot) const { return wanted_.contains(robot); }

 private:
  mutable base::Mutex mutex_;
  std::set<std::string> requests_ GSV_GUARDED_BY(mutex_);  // requests since the last TakeRequests()
  // Used by the thread that takes the requests.
  std::set<std::string> wanted_;
  std::list<std::string> in_order_;  // the robots in the order of requests
};

}  // namespace gsv::gateway
