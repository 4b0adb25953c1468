#include "gsv/recording/mcap/background_sync.h"

#include <utility>

namespace gsv::recording {

BackgroundSync::BackgroundSync(ByteSink& sink) : sink_(sink), thread_([this] { Run(); }) {}

BackgroundSync::~BackgroundSync() {
  {
    const base::MutexLock lock(mutex_);
    is_ending_ = true;
  }
  work_.notify_one();
  thread_.join();
}

void BackgroundSync::RequestSync() {
  {
    const base::MutexLock lock(mutex_);
    is_asked_ = true;
  }
  work_.notify_one();
}

base::Status BackgroundSync::status() const {
  const base::MutexLock lock(mutex_);
  return status_;
}

void BackgroundSync::Run() {
  base::MutexLock lock(mutex_);
  for (;;) {
    work_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return is_asked_ || is_ending_; });
    if (!std::exchange(is_asked_, false)) return;
    lock.unlock();
    base::Status synced = sink_.Sync();
    lock.lock();
    if (!synced && status_) status_ = std::move(synced);
  }
}

}  // namespace gsv::recording
