// What people and programs ask of a simulation: its life cycle, its state, its events.
#include <algorithm>
#include <cstdio>

#include "gsv/base/check.h"
#include "gsv/dynamics/world_engine.h"
#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {
namespace {

constexpr int kCallingThreads = 8;
constexpr std::size_t kMaxEvents = 10'000;

// In real time the behaviours' processes want the other processors: a team one of whose threads has
// to wait for its turn among them is slower than a single thread.
int ThreadsFor(const Specification& specification) {
  if (specification.threads > 0) return specification.threads;
  return specification.mode == Mode::kRealTime ? 1 : base::ThreadTeam::DefaultThreads();
}

base::Status CheckFactor(double factor, const std::string& name) {
  if (factor > 0 && factor <= 1e6) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "the real-time factor must lie above 0 and not above 1e6", name);
}

}  // namespace

base::Result<std::shared_ptr<Simulation>> Simulation::Create(
    Specification specification, std::shared_ptr<const sensing::SensorRegistry> sensors) {
  GSV_CHECK(specification.world != nullptr && sensors != nullptr);
  if (specification.step.count() == 0) specification.step = specification.world->max_step_size;
  if (specification.step < std::chrono::microseconds(1) ||
      specification.step > std::chrono::seconds(10)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the step must lie between 1 microsecond and 10 s", specification.name);
  }
  if (auto ok = CheckFactor(specification.factor, specification.name); !ok)
    return base::Fail(ok.error());
  std::vector<world::Body> bodies;
  for (const model::PlacedModel& placed : specification.world->models) {
    world::Body body;
    body.name = placed.name;
    body.model = placed.model;
    body.initial_pose = placed.world_from_model;
    body.kind = world::KindOf(placed);
    bodies.push_back(std::move(body));
  }
  auto layout = world::MakeLayout(1, std::move(bodies), specification.world);
  auto team = std::make_shared<base::ThreadTeam>(ThreadsFor(specification));
  auto engine = dynamics::MakeWorldEngine(team);
  if (auto ok = engine->SetLayout(layout); !ok) return base::Fail(ok.error());
  return std::shared_ptr<Simulation>(
      new SteppingSimulation(std::move(specification), std::move(sensors), std::move(team),
                             std::move(engine), std::move(layout)),
      [](Simulation* simulation) {
        SteppingSimulation::Dispose(static_cast<SteppingSimulation*>(simulation));
      });
}

base::Result<std::string> Simulation::AddRobot(RobotSpecification robot) {
  std::vector<RobotSpecification> robots;
  robots.push_back(std::move(robot));
  auto names = AddRobots(std::move(robots));
  if (!names) return base::Fail(names.error());
  return names->front();
}

SteppingSimulation::SteppingSimulation(Specification specification,
                                       std::shared_ptr<const sensing::SensorRegistry> sensors,
                                       std::shared_ptr<base::ThreadTeam> team,
                                       std::unique_ptr<dynamics::Engine> engine,
                                       std::shared_ptr<const world::Layout> layout)
    : specification_(std::move(specification)),
      step_(specification_.step),
      sensors_(std::move(sensors)),
      shared_(std::make_shared<SharedState>(std::make_shared<world::Snapshot>(world::Snapshot{
                                                layout, world::InitialState(*layout), {}, {}, {}}),
                                            specification_.mode, specification_.seed, sensors_)),
      team_(std::move(team)),
      engine_(std::move(engine)),
      layout_(std::move(layout)),
      state_(world::InitialState(*layout_)),
      pacer_(step_, specification_.factor),
      factor_(specification_.factor),
      caller_(kCallingThreads) {
  wheel_odometry_.SetLayout(*layout_);
  faults_ = specification_.faults;
  std::stable_sort(faults_.begin(), faults_.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
  for (const world::Body& body : layout_->bodies) {
    if (!body.is_robot()) continue;
    const auto agent = std::make_shared<RobotAgent>(body.name, body.model, false, shared_);
    agent->StartDevices();
    agents_.emplace(body.name, agent);
  }
  IndexAgents();
  instant_.rays = &shared_->rays;
  instant_.seed = specification_.seed;
  stepping_ = std::jthread([this] { RunLoop(); });
  watchdog_ = std::jthread([this] { KeepWatch(); });
}

SteppingSimulation::~SteppingSimulation() {
  {
    const std::lock_guard lock(shared_->mutex);
    quit_ = true;
    if (shared_->phase != Phase::kStopped && shared_->phase != Phase::kFinished) {
      EndAgents("the simulation is gone");
    }
    for (const AgentPtr& agent : AgentsWithBehaviour()) {
      caller_.Post(agent->robot(), [behaviour = agent->behaviour()] { behaviour->Destroy(); });
    }
  }
  shared_->changed.notify_all();
  watch_.notify_all();
  stepping_.join();
  watchdog_.join();
}

base::Status SteppingSimulation::RefuseUnless(std::initializer_list<Phase> allowed,
                                              const char* action) const {
  if (std::find(allowed.begin(), allowed.end(), shared_->phase) != allowed.end()) return {};
  std::string phases;
  for (const Phase phase : allowed)
    phases += (phases.empty() ? "" : " or ") + std::string(ToString(phase));
  return base::Fail(base::ErrorCode::kNotRunning,
                    std::string("to ") + action + " it must be " + phases + ", and it is " +
                        ToString(shared_->phase),
                    specification_.name);
}

void SteppingSimulation::SetPhase(Phase phase) {
  const bool was_running = shared_->phase == Phase::kRunning;
  shared_->phase = phase;
  if (phase == Phase::kRunning && !was_running) {
    restart_pacing_ = true;
    statistics_.Started(WallNow(), shared_->now);
  } else if (was_running && phase != Phase::kRunning) {
    statistics_.Stopped(WallNow(), shared_->now);
  }
  shared_->changed.notify_all();
  phase_changed_.notify_all();
}

base::Status SteppingSimulation::Start() {
  const std::lock_guard control(control_mutex_);
  const std::lock_guard lock(shared_->mutex);
  if (auto ok = RefuseUnless({Phase::kCreated}, "start"); !ok) return ok;
  return Go(SimTime(0), -1);
}

base::Status SteppingSimulation::Go(SimTime until, std::int64_t steps) {
  if (shared_->phase == Phase::kCreated) {
    if (auto ok = CheckFaults(); !ok) return ok;
  }
  ++run_;
  was_started_ = true;
  run_through_.reset();
  run_until_ = until;
  steps_left_ = steps;
  if (shared_->phase == Phase::kPaused) {
    std::vector<AgentPtr> newcomers = AgentsWithBehaviour();
    std::erase_if(newcomers, [](const AgentPtr& agent) { return agent->is_started(); });
    StartAgents(newcomers);
    SetPhase(starts_pending_ > 0 ? Phase::kStarting : Phase::kRunning);
    return {};
  }
  AddEvent("started");
  turns_have_begun_ = true;
  SetPhase(Phase::kStarting);
  StartAgents(AgentsWithBehaviour());
  if (starts_pending_ == 0) SetPhase(Phase::kRunning);
  return {};
}

void SteppingSimulation::StartAgents(const std::vector<AgentPtr>& agents) {
  for (const AgentPtr& agent : agents) {
    agent->MarkStarted();
    ++starts_pending_;
    caller_.Post(agent->robot(), [this, agent] {
      const base::Status status = agent->behaviour()->Start();
      ReportIfFailed(agent, "start", status);
      const std::lock_guard lock(shared_->mutex);
      agent->MarkStarted();
      if (status && agent->behaviour()->local() != nullptr) agent->MakeReady();
      if (--starts_pending_ == 0 && shared_->phase == Phase::kStarting) SetPhase(Phase::kRunning);
    });
  }
}

void SteppingSimulation::ReportIfFailed(const AgentPtr& agent, const char* what,
                                        const base::Status& status) {
  if (status) return;
  const std::lock_guard lock(shared_->mutex);
  const std::string detail = std::string(what) + " failed: " + status.error().Sentence();
  agent->ReportDeath(detail);
  AddEvent("agent_dead", agent->robot(), agent->Describe() + ": " + detail);
  shared_->changed.notify_all();
}

base::Status SteppingSimulation::Pause() {
  const std::lock_guard control(control_mutex_);
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->phase == Phase::kPaused) return {};
    if (auto ok = RefuseUnless({Phase::kStarting, Phase::kRunning}, "pause"); !ok) return ok;
    run_until_ = SimTime(0);
    run_through_.reset();
    steps_left_ = -1;
    SetPhase(Phase::kPaused);
    AddEvent("paused");
  }
  TellBehaviours("pause", &BehaviourPort::Pause);
  return {};
}

base::Status SteppingSimulation::Resume() {
  const std::lock_guard control(control_mutex_);
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->phase == Phase::kRunning || shared_->phase == Phase::kStarting) {
      steps_left_ = -1;  // some steps were asked for, and now it is to go on
      return {};
    }
    if (auto ok = RefuseUnless({Phase::kPaused}, "resume"); !ok) return ok;
    AddEvent("resumed");
    if (auto ok = Go(SimTime(0), -1); !ok) return ok;
  }
  TellBehaviours("resume", &BehaviourPort::Resume);
  return {};
}

base::Status SteppingSimulation::Step(std::int64_t count) {
  const std::lock_guard control(control_mutex_);
  const std::lock_guard lock(shared_->mutex);
  if (count < 1 || count > 1'000'000'000) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the number of steps must lie between 1 and 1e9", specification_.name);
  }
  if (auto ok = RefuseUnless({Phase::kCreated, Phase::kPaused}, "step"); !ok) return ok;
  return Go(SimTime(0), count);
}

base::Status SteppingSimulation::RunUntil(SimTime until) {
  const std::lock_guard control(control_mutex_);
  const std::lock_guard lock(shared_->mutex);
  if (auto ok =
          RefuseUnless({Phase::kCreated, Phase::kPaused, Phase::kStarting, Phase::kRunning}, "run");
      !ok) {
    return ok;
  }
  if (until <= shared_->now) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the time to run until lies " +
                          std::to_string(base::ToSeconds(shared_->now - until)) + " s in the past",
                      specification_.name);
  }
  if (shared_->phase == Phase::kCreated || shared_->phase == Phase::kPaused) return Go(until, -1);
  run_until_ = until;
  return {};
}

base::Status SteppingSimulation::RunThrough(SimTime until) {
  const std::lock_guard control(control_mutex_);
  const std::lock_guard lock(shared_->mutex);
  if (auto ok = RefuseUnless({Phase::kCreated, Phase::kPaused}, "run"); !ok) return ok;
  if (until < shared_->now) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the time to run through is over",
                      specification_.name);
  }
  if (auto ok = Go(SimTime(0), -1); !ok) return ok;
  run_through_ = until;
  return {};
}

base::Status SteppingSimulation::Stop() {
  const std::lock_guard control(control_mutex_);
  const std::lock_guard lock(shared_->mutex);
  if (shared_->phase == Phase::kStopped || shared_->phase == Phase::kFinished ||
      shared_->phase == Phase::kFailed) {
    return {};
  }
  SetPhase(Phase::kStopped);
  AddEvent("stopped");
  EndAgents("the simulation has been stopped");
  return {};
}

void SteppingSimulation::EndAgents(std::string reason) {
  shared_->end_reason = std::move(reason);
  for (const auto& [name, agent] : agents_) agent->gate()->Open();
  for (const AgentPtr& agent : AgentsWithBehaviour()) {
    if (is_stuck_ && agent->in_turn_since()) continue;  // the call would not return either
    caller_.Post(agent->robot(), [behaviour = agent->behaviour()] { (void)behaviour->Stop(); });
  }
}

base::Status SteppingSimulation::Reset() {
  const std::lock_guard control(control_mutex_);
  if (is_stuck_) return RefuseStuck();
  std::vector<AgentPtr> agents;
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->phase == Phase::kCreated) return {};
    SetPhase(Phase::kStopped);
    EndAgents("the simulation is being reset");
    agents = AgentsWithBehaviour();
  }
  if (auto ok = AwaitCalls(); !ok) return ok;
  {
    const auto world_lock = LockWorld();
    if (!world_lock) return RefuseStuck();
    if (auto ok = UndoFaults(); !ok) return ok;
    const std::lock_guard lock(shared_->mutex);
    state_ = world::InitialState(*layout_);
    attachments_.Follow(*layout_, state_, *engine_);
    shared_->sleepers.Clear();
    shared_->commanded.clear();
    shared_->given_up.clear();
    shared_->ready.clear();
    shared_->history.Restart(
        std::make_shared<world::Snapshot>(world::Snapshot{layout_, state_, {}, {}, {}}));
    shared_->now = SimTime(0);
    turns_have_begun_ = false;
    shared_->end_reason.clear();
    for (const auto& [name, agent] : agents_) {
      agent->ResetClocks();
      agent->rack().Reset();
      agent->StartDevices();
    }
    failure_.clear();
    final_hash_.clear();
    run_until_ = SimTime(0);
    run_through_.reset();
    steps_left_ = -1;
    pacer_.ResetLateSteps();
    statistics_ = RunStatistics();
    SetPhase(Phase::kCreated);
    AddEvent("reset");
  }
  for (const AgentPtr& agent : agents)
    ReportIfFailed(agent, "init", agent->behaviour()->Init(agent));
  return {};
}

base::Status SteppingSimulation::SetFactor(double factor) {
  if (auto ok = CheckFactor(factor, specification_.name); !ok) return ok;
  const std::lock_guard lock(shared_->mutex);
  if (shared_->mode == Mode::kLockstep) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "in lockstep a simulation goes as fast as it can, so that there is no factor "
                      "to set",
                      specification_.name);
  }
  if (factor == factor_) return {};
  factor_ = factor;
  pacer_.SetFactor(factor);
  char text[32];
  std::snprintf(text, sizeof text, "%g", factor);
  AddEvent("factor_set", {}, text);
  shared_->changed.notify_all();
  return {};
}

double SteppingSimulation::factor() const {
  const std::lock_guard lock(shared_->mutex);
  return factor_;
}

void SteppingSimulation::TellBehaviours(const char* what, base::Status (BehaviourPort::*call)()) {
  const std::lock_guard lock(shared_->mutex);
  for (const AgentPtr& agent : AgentsWithBehaviour()) {
    caller_.Post(agent->robot(), [this, agent, what, call] {
      // A pause that is not heard is no reason to end anything: the clock stands still anyway.
      if (const auto status = (agent->behaviour().get()->*call)(); !status) {
        AddEvent("behaviour_silent", agent->robot(),
                 std::string(what) + ": " + status.error().Sentence());
      }
    });
  }
}

SimulationStatus SteppingSimulation::status() const {
  SimulationStatus status;
  status.name = specification_.name;
  status.mode = specification_.mode;
  status.step_size = step_;
  {
    const std::lock_guard lock(events_mutex_);
    status.events = events_dropped_ + events_.size();
  }
  const std::lock_guard lock(shared_->mutex);
  const auto snapshot = shared_->history.latest();
  status.target_factor = factor_;
  status.phase = shared_->phase;
  status.step = snapshot->state.step;
  status.time = snapshot->state.time;
  status.real_time_factor = statistics_.real_time_factor();
  status.wall_time = statistics_.wall_time();
  status.mean_step_time = statistics_.mean_step_time();
  status.late_steps = pacer_.late_steps();
  status.failure = failure_;
  for (const auto& [name, agent] : agents_) {
    RobotStatus robot;
    agent->FillStatus(robot);
    if (const int body = snapshot->layout->Find(name); body >= 0) {
      const world::BodyState& state = snapshot->state.bodies[body];
      robot.world_from_robot = state.world_from_model;
      robot.distance = state.distance;
      robot.collisions = state.collisions;
    }
    status.robots.push_back(std::move(robot));
    const bool is_waited_for = shared_->mode == Mode::kLockstep || agent->in_turn_since();
    if (status.waiting_for.empty() && shared_->phase == Phase::kRunning && is_waited_for &&
        agent->IsAtWork()) {
      const double since =
          std::chrono::duration<double>(WallNow() - agent->running_since()).count();
      if (since > 0.1) {
        char text[32];
        std::snprintf(text, sizeof text, " since %.1f s", since);
        status.waiting_for = agent->Describe() + text;
      }
    }
  }
  return status;
}

std::string SteppingSimulation::state_hash() const {
  const auto world_lock = LockWorld();
  if (!world_lock) return {};
  const std::lock_guard lock(shared_->mutex);
  return final_hash_.empty() ? HashNow() : final_hash_;
}

Phase SteppingSimulation::WaitForPhase(const std::vector<Phase>& phases,
                                       std::chrono::milliseconds timeout) const {
  Lock lock(shared_->mutex);
  phase_changed_.wait_for(lock, timeout, [&] {
    return std::find(phases.begin(), phases.end(), shared_->phase) != phases.end();
  });
  return shared_->phase;
}

SteppingSimulation::AgentPtr SteppingSimulation::FindAgent(const std::string& robot) const {
  const std::lock_guard lock(shared_->mutex);
  const auto it = agents_.find(robot);
  return it == agents_.end() ? nullptr : it->second;
}

std::shared_ptr<Agent> SteppingSimulation::agent(const std::string& robot) const {
  return FindAgent(robot);
}

std::vector<SteppingSimulation::AgentPtr> SteppingSimulation::AgentsWithBehaviour() const {
  std::vector<AgentPtr> agents;
  for (const auto& [name, agent] : agents_) {
    if (agent->behaviour() != nullptr) agents.push_back(agent);
  }
  return agents;
}

base::Result<sensing::Reading> SteppingSimulation::Watch(const std::string& robot,
                                                         const std::string& sensor) {
  const AgentPtr found = FindAgent(robot);
  if (found == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no robot \"" + robot + "\"",
                      specification_.name);
  }
  return found->Watch(sensor);
}

std::vector<model::SensorDescription> SteppingSimulation::sensors(const std::string& robot) const {
  const AgentPtr found = FindAgent(robot);
  return found == nullptr ? std::vector<model::SensorDescription>() : found->Sensors();
}

void SteppingSimulation::AddEvent(std::string kind, std::string robot, std::string detail,
                                  std::shared_ptr<const Edit> edit) {
  const auto snapshot = shared_->history.latest();
  const Event event{snapshot->state.step, snapshot->state.time, std::move(kind),
                    std::move(robot),     std::move(detail),    std::move(edit)};
  const std::lock_guard lock(events_mutex_);
  events_.push_back(event);
  if (events_.size() > kMaxEvents) {
    events_.pop_front();
    ++events_dropped_;
  }
  for (const auto& observer : observers_) observer->OnEvent(event);
}

std::vector<Event> SteppingSimulation::events(std::uint64_t first) const {
  const std::lock_guard lock(events_mutex_);
  const std::uint64_t skip = first > events_dropped_ ? first - events_dropped_ : 0;
  if (skip >= events_.size()) return {};
  return {events_.begin() + static_cast<std::ptrdiff_t>(skip), events_.end()};
}

void SteppingSimulation::AddObserver(std::shared_ptr<Observer> observer) {
  const std::lock_guard lock(events_mutex_);
  observers_.push_back(std::move(observer));
}

void SteppingSimulation::RemoveObserver(const std::shared_ptr<Observer>& observer) {
  const std::lock_guard lock(events_mutex_);
  std::erase(observers_, observer);
}

}  // namespace gsv::simulation
