// Has what a sink was given synchronised to its disk, in a thread of its own: a disk may take
// seconds for that, and the writing goes on meanwhile.
//
// Threads  any.
#pragma once

#include <thread>

#include "gsv/base/mutex.h"
#include "gsv/recording/mcap/file_io.h"

namespace gsv::recording {

class BackgroundSync {
 public:
  // `sink` must outlive this, and take writes while it is synchronised.
  explicit BackgroundSync(ByteSink& sink);
  // Waits for what was asked for.
  ~BackgroundSync();

  // All that was written before this call will be synchronised soon. Returns at once.
  void Ask();
  // The first error of the disk.
  base::Status status() const;

 private:
  void Run();

  ByteSink& sink_;
  mutable base::Mutex mutex_;
  base::ConditionVariable work_;
  bool is_asked_ GSV_GUARDED_BY(mutex_) = false;
  bool is_ending_ GSV_GUARDED_BY(mutex_) = false;
  base::Status status_ GSV_GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace gsv::recording
