#include "gsv/simulation/stepping/stepping_simulation.h"

#include <future>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/base/log.h"
#include "gsv/dynamics/world_engine.h"
#include "gsv/simulation/editing/crowd_placement.h"
#include "gsv/world/station.h"

namespace gsv::simulation {
namespace {

constexpr int kCallingThreads = 8;

std::atomic<int> left_to_themselves{0};

// In real time, one thread is used, so that the behaviours' processes can use the other processors.
// A team is slower than one thread if one of its threads has to wait for a processor.
int ThreadsFor(const Specification& specification) {
  if (specification.threads > 0) return specification.threads;
  return specification.mode == Mode::kRealTime ? 1 : base::ThreadTeam::DefaultThreads();
}

base::Status Check(const Specification& specification) {
  if (specification.step < std::chrono::microseconds(1) ||
      specification.step > std::chrono::seconds(10)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the step is " + std::to_string(base::ToSeconds(specification.step)) +
                          " s; it must lie between 1 microsecond and 10 s",
                      specification.name);
  }
  return CheckRealTimeFactor(specification.factor, specification.name);
}

std::shared_ptr<const world::Layout> LayoutOf(
    const std::shared_ptr<const model::WorldDescription>& world) {
  std::vector<world::Body> bodies;
  for (const model::PlacedModel& placed : world->models) {
    world::Body body;
    body.name = placed.name;
    body.model = placed.model;
    body.initial_pose = placed.world_from_model;
    body.kind = world::KindOf(placed);
    bodies.push_back(std::move(body));
  }
  return world::MakeLayout(1, std::move(bodies), world);
}

// Makes the first layout, including the pedestrians, and passes it to the engine.
base::Result<std::shared_ptr<const world::Layout>> FirstLayout(const Specification& specification,
                                                               dynamics::Engine& engine) {
  auto layout = LayoutOf(specification.world);
  auto groups = specification.world->pedestrians;
  for (const model::PedestrianGroup& group : specification.pedestrians) {
    groups.push_back(std::make_shared<const model::PedestrianGroup>(group));
  }
  if (!groups.empty()) return PlacePedestrians(*layout, groups, specification.seed, engine);
  if (auto ok = engine.SetLayout(layout); !ok) return base::Fail(ok.error());
  return layout;
}

std::shared_ptr<SharedState> MakeSharedState(const Specification& specification,
                                             std::shared_ptr<const sensing::SensorRegistry> sensors,
                                             const std::shared_ptr<const world::Layout>& layout) {
  auto start = std::make_shared<world::Snapshot>(
      world::Snapshot{layout, world::InitialState(*layout), {}, {}, {}});
  return std::make_shared<SharedState>(std::move(start), specification.mode, specification.seed,
                                       std::move(sensors));
}

}  // namespace

base::Result<std::shared_ptr<Simulation>> Simulation::Create(
    Specification specification, std::shared_ptr<const sensing::SensorRegistry> sensors) {
  GSV_CHECK(specification.world != nullptr && sensors != nullptr);
  if (specification.step.count() == 0) specification.step = specification.world->max_step_size;
  if (specification.factor == 0) specification.factor = specification.world->real_time_factor;
  if (auto ok = Check(specification); !ok) return base::Fail(ok.error());
  auto team = std::make_shared<base::ThreadTeam>(ThreadsFor(specification));
  auto engine = dynamics::MakeWorldEngine(team);
  auto layout = FirstLayout(specification, *engine);
  if (!layout) return base::Fail(layout.error());
  return std::shared_ptr<Simulation>(
      new SteppingSimulation(std::move(specification), std::move(sensors), std::move(team),
                             std::move(engine), *std::move(layout)),
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
      sensors_(std::move(sensors)),
      shared_(MakeSharedState(specification_, sensors_, layout)),
      world_(std::move(engine), std::move(layout), team),
      events_(shared_->history),
      caller_(kCallingThreads),
      agents_(shared_, events_, caller_),
      life_cycle_(specification_, world_.lock(), shared_, events_, agents_, caller_),
      run_(life_cycle_.run()),
      editor_(world_, shared_, events_),
      faults_(specification_.faults, shared_, events_, agents_, world_, editor_),
      step_loop_({specification_, shared_, events_, caller_, agents_, life_cycle_, world_, faults_,
                  std::move(team)}),
      watchdog_(specification_.deadline, world_.lock(), shared_, events_, agents_, life_cycle_) {
  const SteppingWorldGuard world_guard(world_.lock());
  const SimulationLock lock(*shared_);
  for (const world::Body& body : world_.layout()->bodies) {
    if (world::HasAgent(body)) agents_.Add(body.name, body.model, false, nullptr);
  }
  agents_.AssignBodies(*world_.layout());
  shared_->motions.Follow(*shared_->history.latest());
}

SteppingSimulation::~SteppingSimulation() {
  {
    const SimulationLock lock(*shared_);
    const Phase phase = run_.phase();
    if (phase != Phase::kStopped && phase != Phase::kFinished)
      life_cycle_.EndBehaviours("the simulation does not exist any more");
    agents_.DestroyBehaviours();
    step_loop_.Quit();
  }
  watchdog_.Stop();
  step_loop_.Join();
  caller_.Close();  // before the other members are destroyed, because calls in progress use them
}

int Simulation::AbandonedSimulations() { return left_to_themselves; }

void SteppingSimulation::Dispose(SteppingSimulation* simulation) {
  if (!simulation->agents_.has_hosted()) {
    delete simulation;
    return;
  }
  const std::string name = simulation->specification_.name;
  const auto timeout = simulation->world_.lock().is_stuck() ? WorldLock::kPollPeriod
                                                            : simulation->specification_.deadline;
  std::packaged_task<void()> destroy([simulation] { delete simulation; });
  std::future<void> destroyed = destroy.get_future();
  std::thread thread(std::move(destroy));
  if (destroyed.wait_for(timeout) == std::future_status::ready) return thread.join();
  ++left_to_themselves;
  thread.detach();
  spdlog::warn("{}: an in-process behaviour does not return; gsv abandons the simulation", name);
}

base::Status SteppingSimulation::RefuseStuck() const {
  return base::Fail(base::ErrorCode::kEnded,
                    "an in-process behaviour does not return, so the simulation is stuck; it can "
                    "only be destroyed",
                    specification_.name);
}

SimulationStatus SteppingSimulation::status() const {
  SimulationStatus status;
  status.name = specification_.name;
  status.mode = specification_.mode;
  status.step_size = specification_.step;
  status.events = events_.count();
  status.outputs = events_.output_count();
  const SimulationLock lock(*shared_);
  const auto snapshot = shared_->history.latest();
  status.phase = run_.phase();
  status.failure = run_.failure();
  status.step = snapshot->state.step;
  status.time = snapshot->state.time;
  life_cycle_.pace().FillStatus(status);
  status.robots = agents_.Statuses(*snapshot, specification_.stuck_after);
  if (run_.is_running()) status.waiting_for = agents_.WaitingFor();
  return status;
}

std::shared_ptr<const world::Snapshot> SteppingSimulation::snapshot() const {
  return shared_->history.latest();
}

std::string SteppingSimulation::state_hash() const {
  const WorldGuard world_guard(world_.lock());
  if (!world_guard.is_held()) return {};
  const SimulationLock lock(*shared_);
  return run_.final_hash().empty() ? step_loop_.HashNow() : run_.final_hash();
}

AgentPopulation::AgentPtr SteppingSimulation::FindAgent(const std::string& robot) const {
  const SimulationLock lock(*shared_);
  return agents_.Find(robot);
}

base::Result<AgentPopulation::AgentPtr> SteppingSimulation::RequireAgent(
    const std::string& robot) const {
  AgentPopulation::AgentPtr found = FindAgent(robot);
  if (found != nullptr) return found;
  return base::Fail(base::ErrorCode::kNotFound, "there is no robot \"" + robot + "\"",
                    specification_.name);
}

std::shared_ptr<Agent> SteppingSimulation::agent(const std::string& robot) const {
  return FindAgent(robot);
}

base::Result<sensing::Reading> SteppingSimulation::Watch(const std::string& robot,
                                                         const std::string& sensor) {
  const auto found = RequireAgent(robot);
  if (!found) return base::Fail(found.error());
  return (*found)->Watch(sensor);
}

std::vector<model::SensorDescription> SteppingSimulation::sensors(const std::string& robot) const {
  const auto found = FindAgent(robot);
  return found == nullptr ? std::vector<model::SensorDescription>() : found->Sensors();
}

std::uint64_t SteppingSimulation::sensor_changes() const { return shared_->designs.changes(); }

void SteppingSimulation::SetExpectations(std::weak_ptr<const ExpectationSource> source) {
  const base::MutexLock lock(expectations_mutex_);
  expectations_ = std::move(source);
}

std::vector<ExpectationState> SteppingSimulation::expectations() const {
  std::shared_ptr<const ExpectationSource> source;
  {
    const base::MutexLock lock(expectations_mutex_);
    source = expectations_.lock();
  }
  return source == nullptr ? std::vector<ExpectationState>() : source->states();
}

void SteppingSimulation::AddObserver(std::shared_ptr<Observer> observer) {
  events_.AddObserver(std::move(observer));
}

void SteppingSimulation::RemoveObserver(const std::shared_ptr<Observer>& observer) {
  events_.RemoveObserver(observer);
}

}  // namespace gsv::simulation
