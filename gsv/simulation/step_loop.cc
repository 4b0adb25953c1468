// The stepping thread of a simulation: wake who is due, wait until all wait (or, in real time, for
// the wall clock), step, publish.
#include "gsv/base/check.h"
#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {

void SteppingSimulation::RunLoop() {
  Lock lock(shared_->mutex);
  while (!quit_) {
    if (shared_->phase != Phase::kRunning) {
      shared_->changed.wait(lock);
      continue;
    }
    if (restart_pacing_) {
      restart_pacing_ = false;
      pacer_.Restart(WallNow());
    }
    WakeAgents();
    if (shared_->phase != Phase::kRunning || !AllWait(lock) || !IsDue(lock)) continue;
    lock.unlock();
    TakeStep();
    lock.lock();
  }
}

void SteppingSimulation::WakeAgents() {
  for (const auto& [name, agent] : agents_) {
    if (agent->Wake(shared_->now) && specification_.on_failure == FailurePolicy::kFail) {
      return Fail("the behaviour of " + agent->Describe() + " died");
    }
  }
}

bool SteppingSimulation::AllWait(Lock& lock) {
  if (shared_->mode != Mode::kLockstep) return true;
  for (const auto& [name, agent] : agents_) {
    if (!agent->HoldsUp()) continue;
    const WallTime deadline = agent->running_since() + specification_.deadline;
    shared_->holdup = agent.get();
    // `agents_` may change while the lock is released: hold on to the agent.
    const AgentPtr held = agent;
    const std::cv_status status = shared_->changed.wait_until(lock, deadline);
    shared_->holdup = nullptr;
    if (status == std::cv_status::timeout && shared_->phase == Phase::kRunning && held->HoldsUp() &&
        WallNow() >= held->running_since() + specification_.deadline) {
      const std::string detail = "neither waited nor returned within " +
                                 std::to_string(specification_.deadline.count()) + " ms";
      held->MarkUnresponsive(detail);
      AddEvent("agent_unresponsive", held->robot(),
               held->Describe() + " " + detail + "; its robot stops");
      if (specification_.on_failure == FailurePolicy::kFail) Fail(held->Describe() + " " + detail);
    }
    return false;
  }
  return true;
}

bool SteppingSimulation::IsDue(Lock& lock) {
  if (shared_->mode != Mode::kRealTime) return true;
  if (WallNow() >= pacer_.due()) return true;
  shared_->changed.wait_until(lock, pacer_.due());
  return false;
}

void SteppingSimulation::TakeStep() {
  std::shared_ptr<const world::Snapshot> snapshot;
  {
    const std::lock_guard world_lock(world_mutex_);
    {
      const std::lock_guard lock(shared_->mutex);
      if (shared_->phase != Phase::kRunning) return;
      // Somebody may have come between the check and the locks: a robot added, a clock opened.
      if (shared_->mode == Mode::kLockstep) {
        for (const auto& [name, agent] : agents_) {
          if (agent->HoldsUp()) return;
        }
      }
      for (const auto& [name, agent] : agents_) {
        const auto command = agent->TakeCommand();
        if (!command) continue;
        world::DriveState& drive = state_.bodies[body_of_.at(name)].drive;
        drive.command = *command;
        drive.command_time = state_.time;
      }
      if (shared_->mode == Mode::kRealTime) pacer_.StepStarts(WallNow());
    }
    const WallTime start = WallNow();
    snapshot = MoveWorld();
    AfterStep(snapshot, WallNow() - start);
  }
  std::vector<std::shared_ptr<Observer>> observers;
  {
    const std::lock_guard lock(events_mutex_);
    observers = observers_;
  }
  for (const auto& observer : observers) observer->OnSnapshot(snapshot);
}

std::shared_ptr<const world::Snapshot> SteppingSimulation::MoveWorld() {
  std::vector<world::Contact> contacts;
  engine_->Step(step_, state_, contacts);
  ++state_.step;
  state_.time = state_.step * step_;
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout = layout_;
  snapshot->state = state_;
  snapshot->contacts = std::move(contacts);
  return snapshot;
}

void SteppingSimulation::AfterStep(const std::shared_ptr<const world::Snapshot>& snapshot,
                                   WallDuration duration) {
  shared_->history.Publish(snapshot);
  const std::lock_guard lock(shared_->mutex);
  shared_->now = snapshot->state.time;
  statistics_.Stepped(WallNow(), shared_->now, duration);
  if (steps_left_ > 0) --steps_left_;
  if (specification_.duration.count() > 0 && shared_->now >= specification_.duration)
    return Finish();
  const bool arrived = run_until_.count() > 0 && shared_->now >= run_until_;
  if (steps_left_ == 0 || arrived) {
    run_until_ = SimTime(0);
    steps_left_ = -1;
    if (shared_->phase == Phase::kRunning) {
      SetPhase(Phase::kPaused);
      AddEvent("paused", {}, "as far as it was told to run");
    }
  }
}

void SteppingSimulation::Finish() {
  if (shared_->phase != Phase::kRunning) return;
  final_hash_ = HashNow();
  SetPhase(Phase::kFinished);
  AddEvent("finished");
  EndAgents("the simulation has finished");
}

void SteppingSimulation::Fail(std::string reason) {
  failure_ = std::move(reason);
  SetPhase(Phase::kFailed);
  AddEvent("failed", {}, failure_);
  EndAgents("the simulation has failed: " + failure_);
}

std::string SteppingSimulation::HashNow() const {
  base::Hash hash;
  world::AddToHash(*layout_, state_, hash);
  for (const auto& [name, agent] : agents_) agent->AddToHash(hash);
  return hash.Hex();
}

}  // namespace gsv::simulation
