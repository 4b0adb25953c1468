// Who has died, and who never comes back. A behaviour in process that does not return from its turn
// cannot be interrupted: it keeps its thread and the world, so its simulation has failed, and
// whoever asks for the world is told so instead of waiting for ever.
#include <future>

#include "gsv/base/log.h"
#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(1000);
// How soon somebody who waits for the world sees that it will not be free again.
constexpr auto kLookPeriod = std::chrono::milliseconds(100);

std::atomic<int> left_to_themselves{0};

}  // namespace

void SteppingSimulation::KeepWatch() {
  Lock lock(shared_->mutex);
  while (!quit_) {
    watch_.wait_for(lock, kWatchPeriod, [this] { return quit_; });
    if (quit_) return;
    LookForEndlessTurns();
    LookForDeaths();
  }
}

void SteppingSimulation::LookForDeaths() {
  const bool running = shared_->phase == Phase::kStarting || shared_->phase == Phase::kRunning ||
                       shared_->phase == Phase::kPaused;
  if (!running) return;
  for (const auto& [name, agent] : agents_) {
    if (!agent->is_watched() || watched_now_.contains(name)) continue;
    watched_now_.insert(name);
    caller_.Post("watch " + name, [this, held = agent] {
      const bool dead = held->behaviour()->IsDead();
      const std::lock_guard guard(shared_->mutex);
      watched_now_.erase(held->robot());
      if (!dead || !held->is_watched()) return;
      held->ReportDeath("its process has ended or refuses connections");
      AddEvent("agent_dead", held->robot(),
               held->Describe() + ": its process has ended or refuses connections");
      shared_->changed.notify_all();
    });
  }
}

void SteppingSimulation::LookForEndlessTurns() {
  if (is_stuck_) return;
  const WallTime deadline = WallNow() - specification_.deadline;
  std::string failure;
  for (const auto& [name, agent] : agents_) {
    const auto since = agent->in_turn_since();
    if (!since || *since > deadline) continue;
    is_stuck_ = true;
    const std::string detail = "has not returned from its turn within " +
                               std::to_string(specification_.deadline.count()) +
                               " ms; a behaviour in process cannot be interrupted, so run it as a "
                               "program of its own, without --in-process";
    agent->MarkUnresponsive(detail);
    AddEvent("agent_unresponsive", name, agent->Describe() + " " + detail);
    if (failure.empty()) failure = agent->Describe() + " " + detail;
  }
  if (is_stuck_) Fail(failure);
}

std::unique_lock<std::timed_mutex> SteppingSimulation::LockWorld() const {
  std::unique_lock lock(world_mutex_, std::defer_lock);
  while (!lock.owns_lock() && !is_stuck_) (void)lock.try_lock_for(kLookPeriod);
  return lock;
}

base::Status SteppingSimulation::AwaitCalls() {
  const WallTime deadline = WallNow() + specification_.deadline;
  while (!caller_.WaitUntilIdle(kLookPeriod)) {
    if (is_stuck_) return RefuseStuck();
    if (has_hosted_ && WallNow() > deadline) {
      return base::Fail(base::ErrorCode::kEnded,
                        "a behaviour in process has not returned from stop; the simulation can "
                        "only be destroyed",
                        specification_.name);
    }
  }
  return {};
}

base::Status SteppingSimulation::RefuseStuck() const {
  return base::Fail(base::ErrorCode::kEnded,
                    "a behaviour in process has not returned from its turn and holds the "
                    "simulation up for good; it can only be destroyed",
                    specification_.name);
}

int Simulation::LeftToThemselves() { return left_to_themselves; }

void SteppingSimulation::Dispose(SteppingSimulation* simulation) {
  if (!simulation->has_hosted_) {
    delete simulation;
    return;
  }
  const std::string name = simulation->specification_.name;
  const auto patience = simulation->is_stuck_ ? kLookPeriod : simulation->specification_.deadline;
  std::packaged_task<void()> destroy([simulation] { delete simulation; });
  std::future<void> destroyed = destroy.get_future();
  std::thread thread(std::move(destroy));
  if (destroyed.wait_for(patience) == std::future_status::ready) return thread.join();
  ++left_to_themselves;
  thread.detach();
  spdlog::warn("{}: a behaviour in process does not return; the simulation is left to itself",
               name);
}

}  // namespace gsv::simulation
