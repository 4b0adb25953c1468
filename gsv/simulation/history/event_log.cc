#include "gsv/simulation/history/event_log.h"

#include <algorithm>
#include <utility>

namespace gsv::simulation {

void EventLog::Emit(std::string kind, std::string robot, std::string detail,
                    std::shared_ptr<const Edit> edit) {
  const auto snapshot = history_.latest();
  const Event event{snapshot->state.step, snapshot->state.time, std::move(kind),
                    std::move(robot),     std::move(detail),    std::move(edit)};
  const base::MutexLock lock(mutex_);
  (IsOutput(event) ? outputs_ : events_).Add(event);
  for (const auto& observer : observers_) observer->OnEvent(event);
}

void EventLog::BoundedLog::Add(const Event& event) {
  events.push_back(event);
  if (events.size() <= capacity) return;
  events.pop_front();
  ++dropped;
}

std::vector<Event> EventLog::BoundedLog::Since(std::uint64_t first) const {
  const std::uint64_t skip = first > dropped ? first - dropped : 0;
  if (skip >= events.size()) return {};
  return {events.begin() + static_cast<std::ptrdiff_t>(skip), events.end()};
}

std::vector<Event> EventLog::Since(std::uint64_t first) const {
  const base::MutexLock lock(mutex_);
  return events_.Since(first);
}

std::vector<Event> EventLog::OutputsSince(std::uint64_t first) const {
  const base::MutexLock lock(mutex_);
  return outputs_.Since(first);
}

std::uint64_t EventLog::count() const {
  const base::MutexLock lock(mutex_);
  return events_.dropped + events_.events.size();
}

std::uint64_t EventLog::output_count() const {
  const base::MutexLock lock(mutex_);
  return outputs_.dropped + outputs_.events.size();
}

void EventLog::AddObserver(std::shared_ptr<Observer> observer) {
  const base::MutexLock lock(mutex_);
  observers_.push_back(std::move(observer));
  UpdateFlags();
}

void EventLog::RemoveObserver(const std::shared_ptr<Observer>& observer) {
  const base::MutexLock lock(mutex_);
  std::erase(observers_, observer);
  UpdateFlags();
}

void EventLog::UpdateFlags() {
  has_observers_ = !observers_.empty();
  wants_times_ = std::any_of(observers_.begin(), observers_.end(),
                             [](const auto& observer) { return observer->wants_times(); });
}

std::vector<std::shared_ptr<Observer>> EventLog::Observers() const {
  const base::MutexLock lock(mutex_);
  return observers_;
}

void EventLog::Publish(const std::shared_ptr<const world::Snapshot>& snapshot) const {
  for (const auto& observer : Observers()) observer->OnSnapshot(snapshot);
}

void EventLog::Publish(const StepTimes& times) const {
  for (const auto& observer : Observers()) {
    if (observer->wants_times()) observer->OnTimes(times);
  }
}

}  // namespace gsv::simulation
