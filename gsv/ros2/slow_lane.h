// Publishes slow sources, such as cameras, on a thread of its own, so that fast sources do not
// wait.
//
// Threads  Offer(), Drain() and the destructor from one thread.
// Bounded  one snapshot is being published, and a few wait. If there are more, the oldest is
//          skipped.
#pragma once

#include <deque>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/thread_team.h"
#include "gsv/ros2/source.h"

namespace gsv::ros2 {

// The thread for slow sources, with its queue.
class SlowLane {
 public:
  SlowLane();
  ~SlowLane();

  // Enqueues sources, which must exist until the next Drain(). If `waits` is true, first waits
  // like Drain().
  void Offer(std::vector<Source*> sources, const Moment& moment, bool waits);
  // Waits until all enqueued sources are published.
  void Drain();
  // The number of snapshots that were skipped.
  std::uint64_t skipped() const;

 private:
  static constexpr std::size_t kMaxWaiting = 2;  // maximum number of snapshots that wait

  // The sources to publish for one instant.
  struct Job {
    std::vector<Source*> sources;
    Moment moment;
  };

  void Run();  // the function of thread_
  // Publishes the sources of a job, several at the same time.
  void Do(const Job& job);

  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;                   // notified after changes of the members below
  std::deque<Job> jobs_ GSV_GUARDED_BY(mutex_);       // jobs that have not started
  bool is_working_ GSV_GUARDED_BY(mutex_) = false;    // whether a job is being executed
  std::uint64_t skipped_ GSV_GUARDED_BY(mutex_) = 0;  // number of skipped snapshots
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::unique_ptr<base::ThreadTeam> team_;  // publishes sources; used by `thread_` only
  std::thread thread_;                      // executes Run()
};

}  // namespace gsv::ros2
