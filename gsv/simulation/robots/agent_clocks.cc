#include "gsv/simulation/robots/agent_clocks.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::simulation {

ClockId AgentClocks::Open() {
  clocks_.emplace(next_id_, Clock{});
  return next_id_++;
}

bool AgentClocks::WaitUntil(ClockId id, base::SimTime until, base::SimTime now) {
  const auto it = clocks_.find(id);
  GSV_CHECK(it != clocks_.end());
  Clock& clock = it->second;
  // In a pause, the instant may be reached although the agent has not been woken.
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
  const auto it = clocks_.find(clock);
  return it != clocks_.end() && it->second.waiting;
}

bool AgentClocks::IsWaitingUntil(ClockId clock, base::SimTime until) const {
  const auto it = clocks_.find(clock);
  return it != clocks_.end() && it->second.waiting && it->second.until == until;
}

bool AgentClocks::Wake(base::SimTime now) {
  bool woke = false;
  for (auto& [id, clock] : clocks_) {
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
                     [](const auto& entry) { return !entry.second.waiting; });
}

std::uint64_t AgentClocks::last_cycle(ClockId clock) const {
  const auto it = clocks_.find(clock);
  return it == clocks_.end() ? 0 : it->second.last_cycle;
}

void AgentClocks::set_last_cycle(ClockId clock, std::uint64_t cycle) {
  const auto it = clocks_.find(clock);
  GSV_CHECK(it != clocks_.end());
  it->second.last_cycle = cycle;
}

void AgentClocks::AddToHash(base::Hash& hash) const {
  hash.Add(std::uint64_t{static_cast<std::uint64_t>(next_id_)});
  for (const auto& [id, clock] : clocks_) {
    hash.Add(static_cast<std::uint64_t>(id));
    hash.Add(std::uint64_t{clock.waiting});
    hash.Add(static_cast<std::int64_t>(clock.waiting ? clock.until.count() : 0));
    hash.Add(clock.last_cycle);
  }
}

}  // namespace gsv::simulation
