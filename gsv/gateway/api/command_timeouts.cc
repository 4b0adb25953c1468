#include "gsv/gateway/api/command_timeouts.h"

#include <algorithm>
#include <utility>

namespace gsv::gateway {

CommandTimeouts::CommandTimeouts() : thread_([this] { Run(); }) {}

CommandTimeouts::~CommandTimeouts() {
  {
    const base::MutexLock lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void CommandTimeouts::Set(const std::string& key, std::chrono::nanoseconds timeout,
                          std::function<void()> stop) {
  const auto due = Clock::now() + std::chrono::duration_cast<Clock::duration>(timeout);
  const base::MutexLock lock(mutex_);
  entries_[key] = {due, std::move(stop)};
  changed_.notify_all();
}

void CommandTimeouts::Cancel(const std::string& key) {
  const base::MutexLock lock(mutex_);
  entries_.erase(key);
}

void CommandTimeouts::Run() {
  base::MutexLock lock(mutex_);
  while (!stopping_) {
    const auto first =
        std::min_element(entries_.begin(), entries_.end(),
                         [](const auto& a, const auto& b) { return a.second.due < b.second.due; });
    if (first == entries_.end()) {
      changed_.wait(lock);
      continue;
    }
    if (const auto due = first->second.due; Clock::now() < due) {
      changed_.wait_until(lock, due);
      continue;
    }
    const std::function<void()> stop = std::move(first->second.stop);
    entries_.erase(first);
    lock.unlock();
    stop();
    lock.lock();
  }
}

}  // namespace gsv::gateway
