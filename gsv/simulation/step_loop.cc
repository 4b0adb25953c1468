// The stepping thread of a simulation: wake who is due, give local behaviours their turns, wait
// until all wait (or, in real time, for the wall clock), step, publish.
#include <utility>

#include <pthread.h>
#include <sys/resource.h>

#include "gsv/base/check.h"
#include "gsv/simulation/pace/totals.h"
#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {
namespace {

// Turns that one thread takes at a time: some tens of microseconds of work.
constexpr std::size_t kTurnsAPiece = 16;

constexpr const char* kAsFarAsTold = "as far as it was told to run";

// Has the calling thread run before those of a crowd of behaviours, which all want to run at the
// instant of a step. It takes what the system grants: raising a priority needs CAP_SYS_NICE or a
// limit (ulimit -e) of 30 or more.
void GoBeforeOthers() { (void)setpriority(PRIO_PROCESS, 0, -10); }

}  // namespace

void SteppingSimulation::RunLoop() {
  pthread_setname_np(pthread_self(), "stepping");
  Lock lock(shared_->mutex);
  if (shared_->mode == Mode::kRealTime) GoBeforeOthers();
  while (!quit_) {
    if (shared_->phase != Phase::kRunning) {
      shared_->changed.wait(lock);
      continue;
    }
    if (restart_pacing_) {
      restart_pacing_ = false;
      pacer_.Restart(WallNow());
    }
    if (IsFaultDue()) {
      lock.unlock();
      ApplyFaults();
      lock.lock();
      continue;
    }
    WakeAgents();
    if (!woken_.empty()) {
      lock.unlock();
      gate_opener_.Open(woken_);
      lock.lock();
    }
    if (shared_->phase != Phase::kRunning) continue;
    if (!shared_->ready.empty()) {
      lock.unlock();
      TakeTurns();
      lock.lock();
      continue;
    }
    if (!AllWait(lock) || !IsDue(lock)) continue;
    if (run_through_ && shared_->now >= *run_through_) {
      run_through_.reset();
      SetPhase(Phase::kPaused);
      AddEvent("paused", {}, kAsFarAsTold);
      continue;
    }
    lock.unlock();
    TakeStep();
    lock.lock();
  }
}

void SteppingSimulation::WakeAgents() {
  turns_have_begun_ = true;
  const bool has_reported_deaths = std::exchange(shared_->has_reported_deaths, false);
  for (const auto& [robot, sentence] : std::exchange(shared_->given_up, {})) {
    AddEvent("agent_dead", robot, sentence);
  }
  if (!has_reported_deaths && !shared_->sleepers.HasDue(shared_->now)) return;
  const WallTime wall_now = WallNow();
  const auto wake = [&](RobotAgent& agent) {
    const RobotAgent::Woken woken = agent.Wake(shared_->now, wall_now);
    if (woken.has_passed && !agent.is_hosted()) woken_.push_back(agent.gate());
    if (woken.has_died && specification_.on_failure == FailurePolicy::kFail &&
        shared_->phase == Phase::kRunning) {
      Fail("the behaviour of " + agent.Describe() + " died");
    }
  };
  shared_->sleepers.TakeDue(shared_->now, wake);
  if (!has_reported_deaths) return;
  for (const auto& [name, agent] : agents_) wake(*agent);
}

void SteppingSimulation::TakeTurns() {
  const std::lock_guard world_lock(world_mutex_);
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->phase != Phase::kRunning) return;
    turns_.swap(shared_->ready);
    instant_.now = shared_->now;
    shared_->history.MakeFrame(instant_.snapshots);
  }
  instant_.Prepare(*team_);
  team_->Share(turns_.size(), kTurnsAPiece, [this](std::size_t begin, std::size_t end) {
    sensing::Sampling sampling = instant_.MakeSampling();
    for (std::size_t i = begin; i < end; ++i) turns_[i]->TakeTurn(instant_, sampling);
  });
  const std::lock_guard lock(shared_->mutex);
  is_stuck_ = false;  // it came back after all
  const WallTime deadline = WallNow() - specification_.deadline;
  for (RobotAgent* agent : turns_) {
    if (auto work = agent->Settle()) PostBlocked(agent->shared_from_this(), std::move(work));
    // It may have waited for instants that were here already, again and again.
    if (agent->HoldsUp() && agent->running_since() < deadline) GiveUpOn(*agent);
  }
  turns_.clear();
}

void SteppingSimulation::PostBlocked(AgentPtr agent, std::function<void()> work) {
  const std::string key = "block " + agent->robot();
  caller_.Post(key, [this, agent = std::move(agent), work = std::move(work)] {
    work();
    const std::lock_guard lock(shared_->mutex);
    if (!agent->is_gone()) agent->MakeReady();
    shared_->changed.notify_all();
  });
}

bool SteppingSimulation::AllWait(Lock& lock) {
  if (shared_->mode != Mode::kLockstep || shared_->running == 0) return true;
  AgentPtr longest;
  for (const auto& [name, agent] : agents_) {
    if (!agent->HoldsUp()) continue;
    if (longest == nullptr || agent->running_since() < longest->running_since()) longest = agent;
  }
  GSV_CHECK(longest != nullptr);
  const WallTime deadline = longest->running_since() + specification_.deadline;
  // `agents_` may change while the lock is released: `longest` holds on to the agent.
  const std::cv_status status = shared_->changed.wait_until(lock, deadline);
  if (status == std::cv_status::timeout && shared_->phase == Phase::kRunning &&
      longest->HoldsUp() && WallNow() >= longest->running_since() + specification_.deadline) {
    GiveUpOn(*longest);
  }
  return false;
}

void SteppingSimulation::GiveUpOn(RobotAgent& agent) {
  const std::string detail = "neither waited nor returned within " +
                             std::to_string(specification_.deadline.count()) + " ms";
  agent.MarkUnresponsive(detail);
  AddEvent("agent_unresponsive", agent.robot(),
           agent.Describe() + " " + detail + "; its robot stops");
  if (specification_.on_failure == FailurePolicy::kFail) Fail(agent.Describe() + " " + detail);
}

bool SteppingSimulation::IsDue(Lock& lock) {
  if (shared_->mode != Mode::kRealTime) return true;
  if (WallNow() >= pacer_.due()) return true;
  shared_->changed.wait_until(lock, pacer_.due());
  return false;
}

void SteppingSimulation::ApplyCommands() {
  for (RobotAgent* agent : shared_->commanded) {
    RobotCommands commands = agent->TakeCommands();
    if (const auto& drive = commands.drive()) {
      state_.bodies[agent->body()].drive.command = drive->command;
      state_.bodies[agent->body()].drive.command_time = state_.time;
    }
    for (const auto& [joint, command] : commands.joints()) {
      world::CommandJoint(*layout_, agent->body(), joint, command, state_);
    }
    if (!commands.devices().empty()) {
      device_actions_.emplace_back(agent->robot(), std::move(commands.devices()));
    }
  }
  shared_->commanded.clear();
}

// One step from t to t+h, under world_mutex_:
//
//   unless the simulation has been halted, or some agent still runs (lockstep):
//     apply what agents commanded: drives, joints                      ApplyCommands()
//     apply what agents commanded of devices, by robot and name;
//       each device does its part: hears, grasps                       StepDevices()
//     the engine learns of what devices hold now                       Attachments::Follow()
//     the engine moves bodies and joints by h; devices move what they
//       hold; odometry, contacts and accelerations follow              MoveWorld()
//     publish the snapshot, count the step, pause or finish if that
//       was the last one                                               AfterStep()
//   observers queue the snapshot, without any lock
void SteppingSimulation::TakeStep() {
  std::shared_ptr<const world::Snapshot> snapshot;
  {
    const std::lock_guard world_lock(world_mutex_);
    const WallTime start = WallNow();
    {
      const std::lock_guard lock(shared_->mutex);
      if (shared_->phase != Phase::kRunning) return;
      // Somebody may have come between the check and the locks: a robot added, a clock opened, the
      // last who ran has given up.
      if (shared_->mode == Mode::kLockstep &&
          (shared_->running > 0 || shared_->has_reported_deaths)) {
        return;
      }
      ApplyCommands();
      stepped_run_ = run_;
      if (shared_->mode == Mode::kRealTime) pacer_.StepStarts(start);
    }
    if (state_.devices != nullptr || !device_actions_.empty()) {
      transmissions_ =
          StepDevices(shared_->history.latest(), step_, std::exchange(device_actions_, {}),
                      shared_->rays, team_.get(), state_);
      attachments_.Follow(*layout_, state_, *engine_);
    }
    snapshot = MoveWorld();
    AfterStep(snapshot, start);
  }
  std::vector<std::shared_ptr<Observer>> observers;
  {
    const std::lock_guard lock(events_mutex_);
    if (observers_.empty()) return;
    observers = observers_;
  }
  for (const auto& observer : observers) observer->OnSnapshot(snapshot);
}

std::shared_ptr<const world::Snapshot> SteppingSimulation::MoveWorld() {
  auto snapshot = snapshots_.Take();
  const double step_seconds = base::ToSeconds(step_);
  world::KeepVelocities(state_, snapshot->accelerations);
  wheel_odometry_.KeepWheels(state_);
  engine_->Step(step_, state_, snapshot->contacts);
  MoveDevices(*layout_, state_.time + step_, state_);
  wheel_odometry_.Advance(step_seconds, state_);
  world::FinishContacts(state_, snapshot->accelerations, snapshot->contacts);
  world::FinishAccelerations(state_, step_seconds, snapshot->accelerations);
  ++state_.step;
  state_.time = state_.step * step_;
  snapshot->layout = layout_;
  snapshot->state = state_;
  snapshot->transmissions = std::exchange(transmissions_, {});
  return snapshot;
}

void SteppingSimulation::AfterStep(const std::shared_ptr<const world::Snapshot>& snapshot,
                                   WallTime start) {
  ++ProcessTotals().steps;
  const WallTime end = WallNow();
  const std::lock_guard lock(shared_->mutex);
  shared_->history.Publish(snapshot);  // with the phase that comes of it: see status()
  shared_->now = snapshot->state.time;
  turns_have_begun_ = false;
  statistics_.Stepped(end, shared_->now, end - start);
  // A step that was under way when somebody paused and asked for steps is none of these.
  if (steps_left_ > 0 && stepped_run_ == run_) --steps_left_;
  // Also when somebody paused during this last step: going on later would take one step too many.
  if (specification_.duration.count() > 0 && shared_->now >= specification_.duration)
    return Finish();
  const bool arrived = run_until_.count() > 0 && shared_->now >= run_until_;
  if (steps_left_ == 0 || arrived) {
    run_until_ = SimTime(0);
    steps_left_ = -1;
    if (shared_->phase == Phase::kRunning) {
      SetPhase(Phase::kPaused);
      AddEvent("paused", {}, kAsFarAsTold);
    }
  }
}

void SteppingSimulation::Finish() {
  if (shared_->phase == Phase::kStopped || shared_->phase == Phase::kFailed) return;
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
  if (faults_done_ > 0) hash.Add(std::uint64_t{faults_done_});
  return hash.Hex();
}

}  // namespace gsv::simulation
