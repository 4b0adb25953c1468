// Whose sensors somebody wants to listen to, where there are more than viewers are told of.
//
// Threads  Want() and has_requests() may be called from any; the others from one.
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

  // Looks at what was wanted since the last call; whether that was anything.
  bool TakeRequests();
  // Of more robots than may be wanted, those go that are not `heard` (asked for only then), first
  // who was wanted first. Gives those.
  std::set<std::string> EvictUnheard(const std::function<std::set<std::string>()>& heard);
  bool Contains(const std::string& robot) const { return wanted_.contains(robot); }

 private:
  mutable base::Mutex mutex_;
  std::set<std::string> requests_ GSV_GUARDED_BY(mutex_);
  // Of the thread that takes the wishes.
  std::set<std::string> wanted_;
  std::list<std::string> in_order_;  // the same; who was wanted last is last
};

}  // namespace gsv::gateway
