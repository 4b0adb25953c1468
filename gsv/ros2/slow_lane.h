// Publishes sources that take long, such as cameras, on a thread of its own, so that the others do not wait.
//
// Threads  Offer(), Drain() and the destructor from one.
// Bounded  it works on one snapshot at a time, and a few wait. When more come, the oldest is skipped.
#pragma once

#include <deque>
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

  // Enqueues these, each of which outlives the next Drain(). `waits`: first waits until it is idle.
  void Offer(std::vector<Source*> sources, const Moment& moment, bool waits);
  // Waits until it is idle.
  void Drain();
  // The number of snapshots that were skipped.
  std::uint64_t skipped() const;

 private:
  static constexpr std::size_t kMaxWaiting = 2;

  struct Job {
    std::vector<Source*> sources;
    Moment moment;
  };

  void Run();
  void Do(const Job& job);

  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::deque<Job> jobs_ GSV_GUARDED_BY(mutex_);  // those that wait
  bool is_working_ GSV_GUARDED_BY(mutex_) = false;
  std::uint64_t skipped_ GSV_GUARDED_BY(mutex_) = 0;
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::unique_ptr<base::ThreadTeam> team_;  // used by thread_ only
  std::thread thread_;
};

}  // namespace gsv::ros2
