#include "gsv/ros2/feed.h"

#include <utility>

namespace gsv::ros2 {

void Feed::OnSnapshot(const SnapshotPointer& snapshot) {
  {
    base::MutexLock lock(mutex_);
    bool is_due = false;
    for (auto& [period, instants] : instants_) {
      is_due = instants.AdvanceTo(snapshot->state.time) || is_due;
    }
    if (!is_due || is_closed_) return;
    if (waits_when_full_) {
      room_.wait(lock, [this]() GSV_REQUIRES(mutex_) {
        return is_closed_ || snapshots_.size() < kMaxSnapshots;
      });
    } else if (snapshots_.size() == kMaxSnapshots) {
      snapshots_.pop_front();
      ++dropped_;
    }
    snapshots_.push_back(snapshot);
  }
  news_.notify_one();
}

void Feed::OnEvent(const simulation::Event& event) {
  {
    const base::MutexLock lock(mutex_);
    if (is_closed_ || events_.size() == kMaxEvents) return;
    events_.push_back(event);
  }
  news_.notify_one();
}

void Feed::SetPeriods(const std::set<base::SimTime>& periods) {
  const base::MutexLock lock(mutex_);
  std::erase_if(instants_, [&](const auto& entry) { return !periods.contains(entry.first); });
  for (const base::SimTime period : periods) {
    instants_.try_emplace(period, recording::Instants(period));
  }
}

Feed::News Feed::Next(std::chrono::milliseconds timeout) {
  News news;
  {
    base::MutexLock lock(mutex_);
    news_.wait_for(lock, timeout, [this]() GSV_REQUIRES(mutex_) {
      return is_closed_ || is_woken_ || !snapshots_.empty() || !events_.empty();
    });
    is_woken_ = false;
    news.events = std::exchange(events_, {});
    if (snapshots_.empty()) return news;
    news.snapshot = std::move(snapshots_.front());
    snapshots_.pop_front();
  }
  room_.notify_one();
  return news;
}

void Feed::Wake() {
  {
    const base::MutexLock lock(mutex_);
    is_woken_ = true;
  }
  news_.notify_one();
}

void Feed::Close() {
  {
    const base::MutexLock lock(mutex_);
    is_closed_ = true;
  }
  news_.notify_one();
  room_.notify_all();
}

std::uint64_t Feed::dropped() const {
  const base::MutexLock lock(mutex_);
  return dropped_;
}

}  // namespace gsv::ros2
