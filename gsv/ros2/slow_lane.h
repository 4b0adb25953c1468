// Publishes sources that take long, such as cameras, on a thread of its own, so that the others do not wait.
//
// Threads  Offer(), Drain() and the destructor from one.
// Bounded  one snapshot at a time. What comes while it is at work is skipped.
#pragma once

#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/thread_team.h"
#include "gsv/ros2/source.h"

namespace gsv::ros2 {

class SlowLane {
 public:
  SlowLane();
  ~SlowLane();

  // Publishes these, each of which outlives the next Drain(). Drops them when it is at work; `waits`: waits
  // for the end of that instead.
  void Offer(std::vector<Source*> sources, const Moment& moment, bool waits);
  // Waits until it is idle.
  void Drain();

 private:
  void Run();

  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::vector<Source*> sources_ GSV_GUARDED_BY(mutex_);
  std::unique_ptr<Moment> moment_ GSV_GUARDED_BY(mutex_);  // null: idle
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::unique_ptr<base::ThreadTeam> team_;  // used by thread_ only
  std::thread thread_;
};

}  // namespace gsv::ros2
