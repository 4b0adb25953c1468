#include "gsv/simulation/stepping/watchdog.h"

#include <string>
#include <utility>

namespace gsv::simulation {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(1000);

}  // namespace

Watchdog::Watchdog(std::chrono::milliseconds deadline, WorldLock& world_lock,
                   std::shared_ptr<SharedState> shared, EventLog& events, AgentPopulation& agents,
                   LifeCycle& life_cycle)
    : deadline_(deadline),
      world_lock_(world_lock),
      shared_(std::move(shared)),
      events_(events),
      agents_(agents),
      life_cycle_(life_cycle),
      thread_([this] { Run(); }) {}

void Watchdog::Stop() {
  {
    const SimulationLock lock(*shared_);
    quit_ = true;
  }
  stopped_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Watchdog::Run() {
  SimulationLock lock(*shared_);
  for (;;) {
    stopped_.wait_for(lock.inner(), kWatchPeriod,
                      [this]() GSV_REQUIRES(simulation_mutex) { return quit_; });
    if (quit_) return;
    CheckTurnDeadlines();
    if (IsUnderWay()) agents_.CheckForDeaths();
  }
}

bool Watchdog::IsUnderWay() const {
  const Phase phase = life_cycle_.run().phase();
  return phase == Phase::kStarting || phase == Phase::kRunning || phase == Phase::kPaused;
}

void Watchdog::CheckTurnDeadlines() {
  if (world_lock_.is_stuck()) return;
  const WallTime deadline = WallNow() - deadline_;
  std::string failure;
  for (const auto& [name, agent] : agents_.all()) {
    const auto since = agent->in_turn_since();
    if (!since || *since > deadline) continue;
    const std::string detail = "has not returned from its turn within " +
                               std::to_string(deadline_.count()) +
                               " ms; an in-process behaviour cannot be interrupted, so run it as a "
                               "separate program, without --in-process";
    agent->MarkUnresponsive(detail);
    events_.Emit("agent_unresponsive", name, agent->DescribeInEvents() + " " + detail);
    if (failure.empty()) failure = agent->DescribeInEvents() + " " + detail;
  }
  if (failure.empty()) return;
  world_lock_.SetStuck(true);
  life_cycle_.Fail(failure);
}

}  // namespace gsv::simulation
