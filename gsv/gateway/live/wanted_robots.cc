#include "gsv/gateway/live/wanted_robots.h"

namespace gsv::gateway {

void WantedRobots::Want(const std::string& robot) {
  const base::MutexLock lock(mutex_);
  if (requests_.size() < kMaxWantedRobots) requests_.insert(robot);
}

bool WantedRobots::has_requests() const {
  const base::MutexLock lock(mutex_);
  return !requests_.empty();
}

bool WantedRobots::TakeRequests() {
  std::set<std::string> wishes;
  {
    const base::MutexLock lock(mutex_);
    wishes.swap(requests_);
  }
  for (const std::string& robot : wishes) {
    if (!wanted_.insert(robot).second) in_order_.remove(robot);
    in_order_.push_back(robot);
  }
  return !wishes.empty();
}

std::set<std::string> WantedRobots::EvictUnsubscribed(
    const std::function<std::set<std::string>()>& subscribed) {
  std::set<std::string> gone;
  if (wanted_.size() <= kMaxWantedRobots) return gone;
  const std::set<std::string> kept = subscribed();
  for (auto robot = in_order_.begin();
       robot != in_order_.end() && wanted_.size() > kMaxWantedRobots;) {
    if (kept.contains(*robot)) {
      ++robot;
      continue;
    }
    wanted_.erase(*robot);
    gone.insert(*robot);
    robot = in_order_.erase(robot);
  }
  return gone;
}

}  // namespace gsv::gateway
