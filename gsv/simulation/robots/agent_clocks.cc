#include "gsv/simulation/robots/agent_clocks.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::simulation {

ClockId AgentClocks::Open() {
  clocks_.push_back({.id = next_id_});
  return next_id_++;
}

void AgentClocks::Close(ClockId clock) {
  if (const Clock* const found = Find(clock))
    clocks_.erase(clocks_.begin() + (found - &clocks_[0]));
}

bool AgentClocks::WaitUntil(ClockId id, base::SimTime until, base::SimTime now) {
  Clock* const found = Find(id);
  GSV_CHECK(found != nullptr);
  Clock& clock = *found;
  // Only Wake() ends a pending wait, even if `now` has reached the instant. If the simulation is
  // paused at the instant, Wake() is called when it resumes.
  if (clock.waiting && clock.until == until) return false;
  if (until <= now) {
    clock.waiting = false;
    return true;
  }
  clock.waiting = true;
  clock.until = until;
  return false;
}

bool AgentClocks::IsWaiting(ClockId clock) const {
  const Clock* const found = Find(clock);
  return found != nullptr && found->waiting;
}

bool AgentClocks::IsWaitingUntil(ClockId clock, base::SimTime until) const {
  const Clock* const found = Find(clock);
  return found != nullptr && found->waiting && found->until == until;
}

bool AgentClocks::Wake(base::SimTime now) {
  bool woke = false;
  for (Clock& clock : clocks_) {
    if (clock.waiting && clock.until <= now) {
      clock.waiting = false;
      woke = true;
    }
  }
  return woke;
}

bool AgentClocks::IsRunning() const {
  if (!HasOpened()) return true;
  return std::any_of(clocks_.begin(), clocks_.end(),
                     [](const Clock& clock) { return !clock.waiting; });
}

std::uint64_t AgentClocks::last_cycle(ClockId clock) const {
  const Clock* const found = Find(clock);
  return found == nullptr ? 0 : found->last_cycle;
}

void AgentClocks::set_last_cycle(ClockId clock, std::uint64_t cycle) {
  Clock* const found = Find(clock);
  GSV_CHECK(found != nullptr);
  found->last_cycle = cycle;
}

void AgentClocks::AddToHash(base::Hash& hash) const {
  hash.Add(std::uint64_t{static_cast<std::uint64_t>(next_id_)});
  for (const Clock& clock : clocks_) {
    hash.Add(static_cast<std::uint64_t>(clock.id));
    hash.Add(std::uint64_t{clock.waiting});
    hash.Add(static_cast<std::int64_t>(clock.waiting ? clock.until.count() : 0));
    hash.Add(clock.last_cycle);
  }
}

}  // namespace gsv::simulation
