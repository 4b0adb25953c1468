#include "gsv/simulation/history/event_log.h"

#include <utility>

namespace gsv::simulation {

void EventLog::Emit(std::string kind, std::string robot, std::string detail,
                    std::shared_ptr<const Edit> edit) {
  const auto snapshot = history_.latest();
  const Event event{snapshot->state.step, snapshot->state.time, std::move(kind),
                    std::move(robot),     std::move(detail),    std::move(edit)};
  const base::MutexLock lock(mutex_);
  events_.push_back(event);
  if (events_.size() > capacity_) {
    events_.pop_front();
    ++dropped_;
  }
  for (const auto& observer : observers_) observer->OnEvent(event);
}

std::vector<Event> EventLog::Since(std::uint64_t first) const {
  const base::MutexLock lock(mutex_);
  const std::uint64_t skip = first > dropped_ ? first - dropped_ : 0;
  if (skip >= events_.size()) return {};
  return {events_.begin() + static_cast<std::ptrdiff_t>(skip), events_.end()};
}

std::uint64_t EventLog::count() const {
  const base::MutexLock lock(mutex_);
  return dropped_ + events_.size();
}

void EventLog::AddObserver(std::shared_ptr<Observer> observer) {
  const base::MutexLock lock(mutex_);
  observers_.push_back(std::move(observer));
}

void EventLog::RemoveObserver(const std::shared_ptr<Observer>& observer) {
  const base::MutexLock lock(mutex_);
  std::erase(observers_, observer);
}

void EventLog::Publish(const std::shared_ptr<const world::Snapshot>& snapshot) const {
  std::vector<std::shared_ptr<Observer>> observers;
  {
    const base::MutexLock lock(mutex_);
    if (observers_.empty()) return;
    observers = observers_;
  }
  for (const auto& observer : observers) observer->OnSnapshot(snapshot);
}

}  // namespace gsv::simulation
