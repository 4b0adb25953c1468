// Flushes a file to its disk on a separate thread. A flush may take seconds, and writing continues
// during a flush.
//
// Threads  any.
#pragma once

#include <thread>

#include "gsv/base/mutex.h"
#include "gsv/recording/mcap/file_io.h"

namespace gsv::recording {

class BackgroundSync {
 public:
  // `sink` must outlive this object, and must accept writes during its Sync().
  explicit BackgroundSync(ByteSink& sink);
  // Waits until all requested flushes are done.
  ~BackgroundSync();

  // Requests the synchronisation of everything that was written so far. Returns at once.
  void RequestSync();
  // The first error of a flush, if there was one.
  base::Status status() const;

 private:
  // The function of thread_: flushes the sink whenever is_asked_ is set.
  void Run();

  ByteSink& sink_;
  mutable base::Mutex mutex_;
  base::ConditionVariable work_;  // notified when is_asked_ or is_ending_ is set
  // whether RequestSync() was called since the last flush began
  bool is_asked_ GSV_GUARDED_BY(mutex_) = false;
  bool is_ending_ GSV_GUARDED_BY(mutex_) = false;
  base::Status status_ GSV_GUARDED_BY(mutex_);
  std::thread thread_;  // executes Run()
};

}  // namespace gsv::recording
