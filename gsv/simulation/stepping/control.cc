// Implements requests that change the life cycle of a simulation.
#include <cstdio>
#include <utility>

#include "gsv/simulation/stepping/stepping_simulation.h"

namespace gsv::simulation {

template <typename Request>
base::Status SteppingSimulation::Perform(Request request) {
  const base::MutexLock control(control_mutex_);
  SimulationLock lock(*shared_);
  shared_->AwaitManySteps(lock.inner());
  if (run_.phase() == Phase::kCreated) {
    if (auto ok = faults_.Check(); !ok) return ok;
  }
  const base::Result<RunControl::Change> change = request(run_);
  if (!change) return base::Fail(change.error());
  life_cycle_.Apply(*change);
  return {};
}

base::Status SteppingSimulation::Start() {
  return Perform([](RunControl& run) { return run.Start(); });
}

base::Status SteppingSimulation::Pause() {
  return Perform([this](RunControl& run) GSV_REQUIRES(simulation_mutex) {
    auto change = run.Pause();
    if (change && *change == RunControl::Change::kPaused)
      agents_.CallAll("pause", &BehaviourPort::Pause);
    return change;
  });
}

base::Status SteppingSimulation::Resume() {
  return Perform([this](RunControl& run) GSV_REQUIRES(simulation_mutex) {
    auto change = run.Resume();
    if (change && *change == RunControl::Change::kResumed) {
      events_.Emit("resumed");
      agents_.CallAll("resume", &BehaviourPort::Resume);
    }
    return change;
  });
}

base::Status SteppingSimulation::Step(std::int64_t count) {
  return Perform([count](RunControl& run) { return run.Step(count); });
}

base::Status SteppingSimulation::RunUntil(SimTime until) {
  return Perform([=, this](RunControl& run)
                     GSV_REQUIRES(simulation_mutex) { return run.RunUntil(until, shared_->now); });
}

base::Status SteppingSimulation::RunThrough(SimTime until) {
  return Perform([=, this](RunControl& run) GSV_REQUIRES(simulation_mutex) {
    return run.RunThrough(until, shared_->now);
  });
}

base::Status SteppingSimulation::Stop() {
  const base::MutexLock control(control_mutex_);
  SimulationLock lock(*shared_);
  shared_->AwaitManySteps(lock.inner());
  life_cycle_.Apply(run_.Stop());
  return {};
}

base::Status SteppingSimulation::AwaitCalls() {
  const WallTime deadline = WallNow() + specification_.deadline;
  while (!caller_.WaitUntilIdle(WorldLock::kPollPeriod)) {
    if (world_.lock().is_stuck()) return RefuseStuck();
    if (agents_.has_hosted() && WallNow() > deadline) {
      return base::Fail(base::ErrorCode::kEnded,
                        "an in-process behaviour has not returned from stop; the simulation can "
                        "only be destroyed",
                        specification_.name);
    }
  }
  return {};
}

base::Status SteppingSimulation::Reset() {
  const base::MutexLock control(control_mutex_);
  if (world_.lock().is_stuck()) return RefuseStuck();
  std::vector<std::pair<AgentPopulation::AgentPtr, std::shared_ptr<BehaviourPort>>> behaviours;
  {
    SimulationLock lock(*shared_);
    shared_->AwaitManySteps(lock.inner());
    if (!life_cycle_.BeginReset()) return {};
    for (const auto& agent : agents_.WithBehaviour())
      behaviours.emplace_back(agent, agent->behaviour());
  }
  if (auto ok = AwaitCalls(); !ok) return ok;
  {
    const WorldGuard world_guard(world_.lock());
    if (!world_guard.is_held()) return RefuseStuck();
    if (auto ok = faults_.UndoMoves(); !ok) return ok;
    world_.Reset();
    const SimulationLock lock(*shared_);
    shared_->history.Restart(std::make_shared<world::Snapshot>(world_.InitialSnapshot()));
    shared_->now = SimTime(0);
    faults_.schedule().Rewind();
    agents_.Reset();
    life_cycle_.FinishReset();
  }
  for (const auto& [agent, behaviour] : behaviours)
    agents_.ReportIfFailed(*agent, "init", behaviour->Init(agent));
  return {};
}

base::Status SteppingSimulation::SetRealTimeFactor(double factor) {
  if (auto ok = CheckRealTimeFactor(factor, specification_.name); !ok) return ok;
  const SimulationLock lock(*shared_);
  if (shared_->mode == Mode::kLockstep) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "a simulation in lockstep runs as fast as possible, so it has no real-time factor to set",
        specification_.name);
  }
  if (factor == life_cycle_.pace().target_real_time_factor()) return {};
  life_cycle_.pace().SetRealTimeFactor(factor);
  char text[32];
  std::snprintf(text, sizeof text, "%g", factor);
  events_.Emit("factor_set", {}, text);
  shared_->changed.notify_all();
  return {};
}

double SteppingSimulation::real_time_factor() const {
  const SimulationLock lock(*shared_);
  return life_cycle_.pace().target_real_time_factor();
}

Phase SteppingSimulation::WaitForPhase(const std::vector<Phase>& phases,
                                       std::chrono::milliseconds timeout) const {
  return life_cycle_.WaitForPhase(phases, timeout);
}

}  // namespace gsv::simulation
