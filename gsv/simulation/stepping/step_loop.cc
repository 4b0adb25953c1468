#include "gsv/simulation/stepping/step_loop.h"

#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>

#include <immintrin.h>

#include "gsv/base/check.h"
#include "gsv/simulation/pace/totals.h"

namespace gsv::simulation {
namespace {

// Each thread repeatedly takes a piece of work (some turns) and executes it, which takes some
// microseconds. A piece has kMinTurnsAPiece to kMaxTurnsAPiece turns. If there are few agents, the
// pieces are small enough that each thread gets kPiecesOfAThread of them. So all threads end at
// about the same time. With smaller pieces, threads lock the simulation's mutex more often.
constexpr std::size_t kMinTurnsAPiece = 4, kMaxTurnsAPiece = 16, kPiecesOfAThread = 5;

// The maximum number of steps that are taken at once. A request of a client, such as Pause(), waits
// for their end.
constexpr int kMaxSteps = 8;

// The number of agents whose commands a thread applies at a time.
constexpr std::size_t kAgentsAtOnce = 128;

// While a command is applied, data of later commands is loaded into the cache: of the agent
// kAgentsAhead places later, and of the drive kDrivesAhead places later.
constexpr std::size_t kAgentsAhead = 8, kDrivesAhead = 4;

// If no client shall ring, Bell::wanted is set to Bell::posted plus this number.
constexpr std::uint32_t kNever = 1U << 30U;

// In lockstep, the stepping thread looks for requests after this wall-clock time even if no client
// has rung, because a client may have ended between posting and ringing.
constexpr std::chrono::milliseconds kLongestRest{20};

// How often a thread tries to lock a mutex before it sleeps.
constexpr int kTries = 200;

// The reason in the event of a pause at the end of Step(), RunUntil() or RunThrough().
constexpr const char* kReachedTarget = "the requested time is reached";

// Raises the priority of the calling thread above the priority of behaviours. All behaviours become
// ready to run at the instant of a step. The system may refuse this: a higher priority needs
// CAP_SYS_NICE or a limit (ulimit -e) of 30 or more.
void RaiseThreadPriority() { (void)setpriority(PRIO_PROCESS, 0, -10); }

}  // namespace

StepLoop::StepLoop(Parts parts)
    : parts_(std::move(parts)),
      run_(parts_.life_cycle.run()),
      turn_threads_(static_cast<std::size_t>(parts_.team->threads())) {
  instant_.rays = &parts_.shared->rays;
  instant_.seed = parts_.specification.seed;
  thread_ = std::jthread([this] { Run(); });
}

void StepLoop::Quit() {
  quit_ = true;
  parts_.shared->changed.notify_all();
}

void StepLoop::Join() {
  if (thread_.joinable()) thread_.join();
}

void StepLoop::Run() {
  pthread_setname_np(pthread_self(), "stepping");
  SharedState& shared = *parts_.shared;
  SimulationLock lock(shared);
  if (shared.mode == Mode::kRealTime) RaiseThreadPriority();
  while (!quit_) {
    TakeCycles();
    if (!run_.is_running()) {
      OpenWoken(lock);
      timer_.Interrupt();
      shared.changed.wait(lock.inner(), mark_);
      continue;
    }
    parts_.life_cycle.pace().RestartIfResumed();
    if (parts_.faults.schedule().IsDue(shared.now)) {
      lock.unlock();
      ApplyFaults();
      lock.lock();
      continue;
    }
    WakeAgents();
    OpenWoken(lock);
    if (!run_.is_running()) continue;
    if (shared.has_turns()) {
      lock.unlock();
      TakeTurns();
      lock.lock();
      continue;
    }
    if (!AllWait(lock) || !IsDue(lock)) continue;
    const RunControl::Change change = run_.EndTurns(shared.now);
    if (change != RunControl::Change::kNone) {
      parts_.life_cycle.Apply(change, kReachedTarget);
      continue;
    }
    lock.unlock();
    TakeStep();
    lock.lock();
  }
}

void StepLoop::ApplyFaults() {
  const SteppingWorldGuard world_guard(parts_.world.lock());
  SimulationLock lock(*parts_.shared);
  FaultSchedule& schedule = parts_.faults.schedule();
  while (run_.is_running() && schedule.IsDue(parts_.shared->now)) {
    const scenario::Fault& fault = schedule.TakeDue();
    lock.unlock();
    const base::Status injected = parts_.faults.Inject(fault);
    lock.lock();
    if (injected) continue;
    if (run_.is_running()) parts_.life_cycle.Fail(injected.error().Sentence());
    return;
  }
}

void StepLoop::WakeAgents() {
  SharedState& shared = *parts_.shared;
  run_.BeginTurns();
  const bool has_reported_deaths = std::exchange(shared.has_reported_deaths, false);
  for (const auto& [robot, sentence] : std::exchange(shared.given_up, {})) {
    parts_.events.Emit("agent_dead", robot, sentence);
  }
  if (!has_reported_deaths) shared.turn_sleepers.TakeDue(shared.now, shared.due);
  if (!has_reported_deaths && !shared.sleepers.HasDue(shared.now)) return;
  const WallTime wall_now = WallNow();
  const auto wake = [&](RobotAgent& agent) {
    simulation_mutex.AssertHeld();  // the calling function holds the mutex
    const RobotAgent::Woken woken = agent.Wake(shared.now, wall_now);
    if (woken.has_passed && !agent.is_hosted()) agent.CollectWoken(woken, woken_);
    if (woken.has_died) FailIfRequired(agent);
  };
  shared.sleepers.TakeDue(shared.now, wake);
  if (!has_reported_deaths) return;
  shared.turn_sleepers.TakeDue(shared.now, wake);
  for (const auto& [name, agent] : parts_.agents.all()) wake(*agent);
}

// Takes the requests that clients have posted to their channels. Also decides which clients ring.
// In lockstep, the next step waits for some clients, and the last of these clients to post rings.
// In real time, no client rings, because the next step comes soon. While the run is paused, each
// client rings. A client also rings if the instant for which its request waits has been reached.
void StepLoop::TakeCycles() {
  SharedState& shared = *parts_.shared;
  mark_ = shared.changed.mark();
  may_have_missed_a_ring_ = false;
  if (shared.channels.empty()) return;
  exchange::Bell& bell = *shared.channels.bell();
  bell.now_ns.store(shared.now.count(), std::memory_order_relaxed);
  const std::uint32_t posted =
      bell.posted;  // read before the requests are taken, so that no client rings too late
  std::uint32_t awaited = 0;
  for (const CycleChannels::Channel& each : shared.channels.all()) {
    each.agent->BeginCycle(each.channel, woken_);
    awaited += each.channel->is_used() && each.agent->IsAwaited(*each.channel) ? 1 : 0;
  }
  if (!run_.is_running()) {
    awaited = 0;
  } else if (shared.mode == Mode::kRealTime) {
    awaited = kNever;
  }
  bell.wanted = posted + awaited;
  // A client may have posted a request before `wanted` was changed. It has then compared `posted`
  // with the previous value of `wanted`, so it may not have rung.
  may_have_missed_a_ring_ = awaited > 0 && exchange::HasReached(bell.posted, bell.wanted);
}

void StepLoop::OpenWoken(SimulationLock& lock) {
  if (woken_.empty()) return;
  lock.unlock();
  event_signaler_.Open(woken_);
  lock.lock();
}

void StepLoop::FailIfRequired(const RobotAgent& dead) {
  if (parts_.specification.on_failure != FailurePolicy::kFail || !run_.is_running()) return;
  parts_.life_cycle.Fail("the behaviour of " + dead.DescribeInEvents() + " died");
}

void StepLoop::TakeTurns() {
  SharedState& shared = *parts_.shared;
  const SteppingWorldGuard world_guard(parts_.world.lock());
  {
    const SimulationLock lock(shared);
    if (!run_.is_running()) return;
    turns_.swap(shared.ready);
    awake_ = turns_.size();
    turns_.insert(turns_.end(), shared.due.begin(), shared.due.end());
    shared.due.clear();
    instant_.now = shared.now;
    instant_.is_timed = is_timed_;
    shared.history.MakeFrame(instant_.snapshots);
  }
  instant_.Prepare(*parts_.team);
  results_.resize(turns_.size());  // TakePiece() sets all values
  // Each thread has its own sampling, so that threads do not write to the same reference counts.
  for (TurnThread& thread : turn_threads_) {
    thread.sampling.emplace(instant_.MakeSampling());
    thread.begin = thread.end = 0;
  }
  const std::size_t pieces = kPiecesOfAThread * turn_threads_.size();
  const std::size_t a_piece = std::clamp(turns_.size() / pieces, kMinTurnsAPiece, kMaxTurnsAPiece);
  // Takes pieces of the turns, and applies the last piece of each thread.
  struct {
    void operator()(std::size_t begin, std::size_t end, std::size_t thread) const {
      loop.TakePiece(begin, end, loop.turn_threads_[thread]);
    }
    void End(std::size_t thread) const {
      TurnThread& of = loop.turn_threads_[thread];
      if (of.begin < of.end) loop.ApplyAndWake(of.end, of.end, of);
    }
    StepLoop& loop;
  } const take_turns{*this};
  parts_.team->ParallelFor(turns_.size(), a_piece, take_turns);
  for (TurnThread& thread : turn_threads_) thread.sampling.reset();
  const SimulationLock lock(shared);
  parts_.world.lock().SetStuck(false);  // all turns have ended, even too long ones
  const WallTime deadline = WallNow() - parts_.specification.deadline;
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    RobotAgent* const agent = turns_[i];
    const auto& [end, outcome] = results_[i];
    if (outcome == TurnOutcome::kDied) FailIfRequired(*agent);
    if (outcome != TurnOutcome::kTaken) continue;
    if (end.is_usual) {
      Enlist(*agent, end);
      continue;
    }
    if (auto work = agent->ApplyTurn()) PostBlocked(agent->shared_from_this(), std::move(work));
    // A turn may end in a wait for an instant that has already passed. The agent then still blocks
    // the step, and the deadline of the agent applies.
    if (agent->BlocksStep() && agent->running_since() < deadline) GiveUpOn(*agent);
  }
  if (shared.running == 0) shared.changed.notify_all();
  if (is_timed_) NoteLongestTurn();
  turns_.clear();
}

void StepLoop::TakePiece(std::size_t begin, std::size_t end, TurnThread& thread) {
  for (std::size_t i = begin; i < end; ++i) {
    turns_[i]->Prefetch();
    results_[i].end.is_usual = false;
    results_[i].outcome = TurnOutcome::kTaken;
  }
  ApplyAndWake(std::max(begin, std::min(awake_, end)), end, thread);
  const auto prefetch_behaviour = [&](std::size_t i) {
    if (i < end) turns_[i]->PrefetchBehaviour(*instant_.snapshots.latest());
  };
  const auto prefetch_turn = [&](std::size_t i) {
    if (i < end) turns_[i]->PrefetchTurn();
  };
  // Each stage needs addresses that the previous stage has loaded.
  for (std::size_t i = begin; i < begin + 4; ++i) prefetch_behaviour(i);
  for (std::size_t i = begin; i < begin + 2; ++i) prefetch_turn(i);
  for (std::size_t i = begin; i < end; ++i) {
    prefetch_behaviour(i + 4);
    prefetch_turn(i + 2);
    if (results_[i].outcome == TurnOutcome::kTaken) turns_[i]->TakeTurn(instant_, *thread.sampling);
  }
  thread.begin = begin, thread.end = end;
}

// Applies a thread's previous piece and wakes the agents of its next piece under one lock of the
// mutex. Locking is slow, because usually another thread was the last one to lock the mutex. The
// agents of the previous piece are still in the cache. Another thread keeps the mutex locked for at
// most about a microsecond. To sleep would take longer, so this thread first tries several times to
// lock the mutex.
void StepLoop::ApplyAndWake(std::size_t begin, std::size_t end, TurnThread& thread) {
  base::Mutex& mutex = parts_.shared->mutex;
  int tries = 0;
  while (!mutex.try_lock()) {
    if (++tries < kTries) {
      _mm_pause();
      continue;
    }
    mutex.lock();
    break;
  }
  simulation_mutex.AssertHeld();  // `mutex` is the simulation's mutex
  const SimTime now = parts_.shared->now;
  for (std::size_t i = thread.begin; i < thread.end; ++i) {
    if (results_[i].outcome == TurnOutcome::kTaken)
      results_[i].end = turns_[i]->ApplyUsualTurn(now);
  }
  const WallTime wall_now = WallNow();
  for (std::size_t i = begin; i < end; ++i) {
    const RobotAgent::Woken woken = turns_[i]->WakeForTurn(now, wall_now);
    results_[i].outcome = woken.has_died     ? TurnOutcome::kDied
                          : woken.has_passed ? TurnOutcome::kTaken
                                             : TurnOutcome::kNone;
  }
  mutex.unlock();
}

void StepLoop::Enlist(RobotAgent& agent, const RobotAgent::UsualEnd& end) {
  SharedState& shared = *parts_.shared;
  if (end.has_drive) shared.drives.push_back({&agent, end.drive});
  if (end.has_command) shared.commanded.push_back(&agent);
  shared.turn_sleepers.Add(end.until, &agent);
  if (end.was_counted) --shared.running;
}

void StepLoop::NoteLongestTurn() {
  SharedState& shared = *parts_.shared;
  if (shared.mode == Mode::kLockstep && shared.running > 0) return;
  const auto longest = std::max_element(
      turns_.begin(), turns_.end(),
      [](const RobotAgent* a, const RobotAgent* b) { return a->turn_took() < b->turn_took(); });
  if (longest != turns_.end()) shared.held_up_by = (*longest)->robot();
}

void StepLoop::PostBlocked(AgentPopulation::AgentPtr agent, std::function<void()> work) {
  const std::string key = "block " + agent->robot();
  parts_.caller.Post(key,
                     [shared = parts_.shared, agent = std::move(agent), work = std::move(work)] {
                       work();
                       const SimulationLock lock(*shared);
                       if (!agent->is_removed()) agent->MakeReady();
                       shared->changed.notify_all();
                     });
}

bool StepLoop::AllWait(SimulationLock& lock) {
  SharedState& shared = *parts_.shared;
  if (shared.mode != Mode::kLockstep || shared.running == 0) return true;
  if (!shared.channels.empty()) {
    TakeCycles();  // the agents that WakeAgents() has woken are awaited now
    if (shared.running == 0 || !woken_.empty() || may_have_missed_a_ring_) return false;
  }
  AgentPopulation::AgentPtr longest;
  for (const auto& [name, agent] : parts_.agents.all()) {
    if (!agent->BlocksStep()) continue;
    if (longest == nullptr || agent->running_since() < longest->running_since()) longest = agent;
  }
  GSV_CHECK(longest != nullptr);
  const auto deadline = [&]() GSV_REQUIRES(simulation_mutex) {
    return longest->running_since() + parts_.specification.deadline;
  };
  // Agents may be removed while the lock is released, so `longest` keeps this agent alive.
  WallTime until = deadline();
  if (!shared.channels.empty()) until = std::min(until, WallNow() + kLongestRest);
  const std::cv_status status = shared.changed.wait_until(lock.inner(), until, mark_);
  if (status == std::cv_status::timeout && run_.is_running() && longest->BlocksStep() &&
      WallNow() >= deadline()) {
    GiveUpOn(*longest);
  }
  return false;
}

void StepLoop::GiveUpOn(RobotAgent& agent) {
  const std::string detail = "neither called a wait function nor returned within " +
                             std::to_string(parts_.specification.deadline.count()) + " ms";
  agent.MarkUnresponsive(detail);
  parts_.events.Emit("agent_unresponsive", agent.robot(),
                     agent.DescribeInEvents() + " " + detail + "; its robot stops");
  if (parts_.specification.on_failure == FailurePolicy::kFail)
    parts_.life_cycle.Fail(agent.DescribeInEvents() + " " + detail);
}

bool StepLoop::IsDue(SimulationLock& lock) {
  if (parts_.shared->mode != Mode::kRealTime) return true;
  const WallTime due = parts_.life_cycle.pace().due();
  const WallTime now = WallNow();
  if (now >= due) return true;
  parts_.shared->changed.wait_until(lock.inner(), due, mark_);
  if (is_timed_) timer_.AddIdle(WallNow() - now);
  return false;
}

// One step, from t to t + h:
//
//   lock the world
//     return if the run has been paused, or if an agent has resumed since the last check
//     apply the commands of agents: drives and joints           they apply from t on
//     apply their commands of devices, by robot and name;
//       then each device takes its part in the step             it sees the snapshot at t
//     attach and detach the bodies that devices grasp and release
//     move bodies and joints by h                               dynamics::Engine
//       or by several steps, if nobody needs the states between  MaxSteps()
//     devices move attached bodies; odometry, contacts and accelerations follow
//     publish the snapshot at t + h, and with it the phase
//       that the run enters at its end                          RunControl
//   pass the snapshot to the observers, without a lock
void StepLoop::TakeStep() {
  SimulatedWorld& world = parts_.world;
  SharedState& shared = *parts_.shared;
  const SimTime length = parts_.specification.step;
  std::shared_ptr<world::Snapshot> snapshot;
  {
    const SteppingWorldGuard world_guard(world.lock());
    const WallTime start = WallNow();
    const int max_steps = BeginStep(start);
    if (max_steps == 0) return;
    std::vector<world::Transmission> transmissions;
    if (world.state().devices != nullptr || !device_actions_.empty()) {
      transmissions =
          StepDevices(shared.history.latest(), length, std::exchange(device_actions_, {}),
                      shared.rays, parts_.team.get(), shared.seed, world.state());
      world.FollowAttachments();
    }
    if (is_timed_) timer_.Mark(&StepTimes::devices);
    snapshot = snapshots_.Take();
    const std::shared_ptr<const world::Layout>& layout = world.layout();
    std::unique_ptr<sensing::SceneDraft> scene =
        drafts_scene_ ? shared.rays.Begin(layout) : nullptr;
    const int steps = world.Step(length, max_steps, *snapshot, scene.get());
    if (steps > 1 && scene != nullptr) shared.rays.Add(snapshot, std::move(scene));
    snapshot->transmissions = std::move(transmissions);
    EndStep(snapshot, start, steps);
    if (is_timed_) timer_.Mark(&StepTimes::bodies);
  }
  parts_.events.Publish(snapshot);
  if (!is_timed_) return;
  timer_.Mark(&StepTimes::observers);
  parts_.events.Publish(timer_.End(snapshot->state.step, snapshot->state.time));
}

int StepLoop::BeginStep(WallTime start) {
  SharedState& shared = *parts_.shared;
  const SimulationLock lock(shared);
  if (!run_.is_running()) return 0;
  // Check again: before the locks were taken, a robot may have been added, a clock may have been
  // opened, or the last running agent may have ended.
  if (shared.mode == Mode::kLockstep && (shared.running > 0 || shared.has_reported_deaths))
    return 0;
  is_timed_ = shared.is_timed = parts_.events.wants_times();
  if (is_timed_) {
    timer_.Begin(start, std::exchange(shared.held_up_by, {}));
  } else {
    timer_.Interrupt();
  }
  ApplyCommands();
  run_.BeginStep();
  if (shared.mode == Mode::kRealTime) parts_.life_cycle.pace().StepStarts(start);
  const int max_steps = MaxSteps();
  shared.takes_many = max_steps > 1;
  drafts_scene_ = max_steps > 1 && WillCastRays(max_steps);
  return max_steps;
}

bool StepLoop::WillCastRays(int steps) const {
  const SharedState& shared = *parts_.shared;
  const SimTime end = shared.now + steps * parts_.specification.step;
  return instant_.casts_rays.load(std::memory_order_relaxed) && shared.turn_sleepers.HasDue(end);
}

// Several steps at once end at the first step at which an agent wakes, a fault is due, a sensor or
// the history of motions samples the world, or the run may pause. So the result is the same as with
// single steps.
int StepLoop::MaxSteps() const {
  const SharedState& shared = *parts_.shared;
  const bool needs_each_step = shared.mode != Mode::kLockstep || is_timed_ ||
                               parts_.events.has_observers() || !shared.channels.empty() ||
                               shared.waiting_requests > 0 || !device_actions_.empty() ||
                               parts_.world.state().devices != nullptr;
  if (needs_each_step) return 1;
  const SimTime length = parts_.specification.step;
  const int steps = run_.StepsAtOnce(shared.now, length, kMaxSteps);
  SimTime end = shared.now + steps * length;
  end = shared.sleepers.Next(end);
  end = shared.turn_sleepers.Next(end);
  end = parts_.faults.schedule().Next(end);
  end = std::min(end, MotionHistory::NextSampling(shared.now));
  end = shared.history.NextSampling(end);
  return static_cast<int>(std::max<std::int64_t>(StepsUntil(shared.now, end, length), 1));
}

void StepLoop::ApplyCommands() {
  world::State& state = parts_.world.state();
  std::vector<SharedState::DriveOrder>& drives = parts_.shared->drives;
  parts_.team->ParallelFor(drives.size(), kAgentsAtOnce, [&](std::size_t begin, std::size_t end) {
    simulation_mutex.AssertHeld();  // the stepping thread holds the mutex, and waits here
    for (std::size_t i = begin; i < end; ++i) {
      if (i + kAgentsAhead < end) drives[i + kAgentsAhead].agent->PrefetchBody();
      if (i + kDrivesAhead < end) drives[i + kDrivesAhead].agent->PrefetchDrive(state);
      drives[i].agent->ApplyDrive(drives[i].command, state);
    }
  });
  drives.clear();
  std::vector<RobotAgent*>& commanded = parts_.shared->commanded;
  parts_.team->ParallelFor(
      commanded.size(), kAgentsAtOnce, [&](std::size_t begin, std::size_t end) {
        simulation_mutex.AssertHeld();  // the stepping thread holds the mutex, and waits here
        for (std::size_t i = begin; i < end; ++i) {
          if (i + kAgentsAhead < end) commanded[i + kAgentsAhead]->PrefetchCommands();
          if (i + kDrivesAhead < end) commanded[i + kDrivesAhead]->PrefetchDrive(state);
          if (commanded[i]->ApplyDriveCommand(state)) commanded[i] = nullptr;
        }
      });
  for (RobotAgent* agent : commanded) {
    if (agent == nullptr) continue;
    RobotCommands commands = agent->TakeCommands();
    if (const auto& drive = commands.drive()) {
      world::DriveState& driven = state.bodies[static_cast<std::size_t>(agent->body())].drive;
      driven.command = drive->command;
      driven.command_time = state.time;
    }
    for (const auto& [joint, command] : commands.joints()) {
      world::CommandJoint(*parts_.world.layout(), agent->body(), joint, command, state);
    }
    if (!commands.devices().empty()) {
      device_actions_.emplace_back(agent->robot(), std::move(commands.devices()));
    }
  }
  commanded.clear();
}

void StepLoop::EndStep(const std::shared_ptr<const world::Snapshot>& snapshot, WallTime start,
                       int steps) {
  ProcessTotals().steps += static_cast<std::uint64_t>(steps);
  SharedState& shared = *parts_.shared;
  const WallTime end = WallNow();
  const SimulationLock lock(shared);
  if (std::exchange(shared.takes_many, false) && shared.waiting_requests > 0) {
    shared.many_taken.notify_all();
  }
  // The snapshot and its phase become visible at the same time, see Simulation::status().
  shared.history.Publish(snapshot);
  shared.now = snapshot->state.time;
  shared.motions.Follow(*snapshot);
  parts_.life_cycle.pace().StepEnds(start, end, shared.now, steps);
  const RunControl::Change change = run_.EndStep(shared.now, steps);
  if (change == RunControl::Change::kNone) return;
  const bool has_finished = change == RunControl::Change::kFinished;
  if (has_finished) run_.SetFinalHash(HashNow());
  parts_.life_cycle.Apply(change, has_finished ? "" : kReachedTarget);
}

std::string StepLoop::HashNow() const {
  base::Hash hash;
  world::AddToHash(*parts_.world.layout(), parts_.world.state(), hash);
  for (const auto& [name, agent] : parts_.agents.all()) agent->AddToHash(hash);
  const std::size_t faults = parts_.faults.schedule().done();
  if (faults > 0) hash.Add(std::uint64_t{faults});
  const geometry::Vector3& gravity = parts_.world.layout()->description->gravity;
  if (gravity != parts_.specification.world->gravity) {
    for (const double each : {gravity.x, gravity.y, gravity.z}) hash.Add(each);
  }
  return hash.Hex();
}

}  // namespace gsv::simulation
