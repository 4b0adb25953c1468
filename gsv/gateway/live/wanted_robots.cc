#include "gsv/gateway/live/wanted_robots.h"

namespace gsv::gateway {

void WantedRobots::Want(const std::string& robot) {
  const base::MutexLock lock(mutex_);
  if (wishes_.size() < kMostWantedRobots) wishes_.insert(robot);
}

bool WantedRobots::has_wishes() const {
  const base::MutexLock lock(mutex_);
  return !wishes_.empty();
}

bool WantedRobots::TakeWishes() {
  std::set<std::string> wishes;
  {
    const base::MutexLock lock(mutex_);
    wishes.swap(wishes_);
  }
  for (const std::string& robot : wishes) {
    if (!wanted_.insert(robot).second) in_order_.remove(robot);
    in_order_.push_back(robot);
  }
  return !wishes.empty();
}

std::set<std::string> WantedRobots::MakeRoom(const std::function<std::set<std::string>()>& heard) {
  std::set<std::string> gone;
  if (wanted_.size() <= kMostWantedRobots) return gone;
  const std::set<std::string> stay = heard();
  for (auto robot = in_order_.begin();
       robot != in_order_.end() && wanted_.size() > kMostWantedRobots;) {
    if (stay.contains(*robot)) {
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
