// Synchronises a sink to its disk on its own thread. This may take seconds, and writing continues
// meanwhile.
//
// Threads  any.
#pragma once

#include <thread>

#include "gsv/base/mutex.h"
#include "gsv/recording/mcap/file_io.h"

namespace gsv::recording {

class BackgroundSync {
 public:
  // `sink` must outlive this object, and must accept writes while it is synchronised.
  explicit BackgroundSync(ByteSink& sink);
  // Waits for the requested synchronisations.
  ~BackgroundSync();

  // Requests the synchronisation of everything that was written so far. Returns at once.
  void Ask();
  // The first error of the disk, if there was one.
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
