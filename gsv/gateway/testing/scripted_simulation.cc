#include "gsv/gateway/testing/scripted_simulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/gateway/testing/arena.h"
#include "gsv/sensing/devices/built_in.h"

namespace gsv::gateway::testing {

using base::ErrorCode;
using simulation::Phase;

namespace {

constexpr double kTurnRate = 0.2;   // angular velocity of the robots about the arena's middle,
                                    // rad/s
constexpr double kWheelRate = 1.0;  // rad/s
const char* const kAvatar = "avatar";

std::string RobotName(int i) { return "robot_" + std::to_string(i); }

double RadiusOf(int robot) { return 1 + 0.5 * robot; }

geometry::Pose PoseOf(int robot, double seconds) {
  const double angle = robot + kTurnRate * seconds;
  return geometry::PlanarPose(RadiusOf(robot) * std::cos(angle), RadiusOf(robot) * std::sin(angle),
                              0, angle + std::numbers::pi / 2);
}

base::Status Refused() {
  return base::Fail(ErrorCode::kInvalidArgument, "a scripted simulation cannot do this");
}

}  // namespace

class ScriptedSimulation::Avatar final : public simulation::Agent {
 public:
  const std::string& robot() const override { return name_; }
  std::string model() const override { return "circler"; }
  double footprint_radius() const override { return 0.3; }
  geometry::Pose RobotFromLink(int) const override { return {}; }
  base::Result<simulation::ClockId> OpenClock() override { return base::Fail(Refused().error()); }
  base::Status CloseClock(simulation::ClockId) override { return Refused(); }
  base::Status GiveUp(simulation::ClockId, const std::string&) override { return Refused(); }
  base::SimTime Now() const override { return base::SimTime(0); }
  base::Result<simulation::Wait> SleepUntil(simulation::ClockId, base::SimTime,
                                            std::chrono::milliseconds) override {
    return base::Fail(Refused().error());
  }
  base::Result<simulation::Exchanged> Exchange(simulation::ClockId, std::uint64_t,
                                               std::optional<world::DriveCommand>, base::SimTime,
                                               std::chrono::milliseconds) override {
    return base::Fail(Refused().error());
  }
  base::Result<simulation::Exchanged> SleepAndRead(simulation::ClockId,
                                                   std::optional<world::DriveCommand>,
                                                   base::SimTime, std::chrono::milliseconds,
                                                   const std::set<std::string>&) override {
    return base::Fail(Refused().error());
  }
  base::Result<simulation::CycleMemory> ShareMemory(simulation::ClockId) override {
    return base::Fail(Refused().error());
  }
  base::Status Command(const world::DriveCommand& command) override {
    const std::lock_guard lock(mutex_);
    command_ = command;
    return {};
  }
  const std::vector<model::Joint>& Joints() const override { return joints_; }
  base::Status CommandJoint(int joint, const world::JointCommand& command) override {
    const std::lock_guard lock(mutex_);
    joint_command_ = {joint, command};
    return {};
  }
  base::Result<simulation::JointReading> ReadJoint(int) override {
    return base::Fail(Refused().error());
  }
  std::vector<model::SensorDescription> Sensors() const override { return {}; }
  std::vector<std::string> SensorTypes() const override { return {}; }
  base::Status OpenSensor(const std::string&) override { return Refused(); }
  base::Status CreateSensor(model::SensorDescription) override { return Refused(); }
  base::Status CloseSensor(const std::string&) override { return Refused(); }
  base::Result<sensing::Reading> Read(const std::string&) override {
    return base::Fail(Refused().error());
  }
  base::Status Send(const std::string&, const std::string&, std::string) override {
    return Refused();
  }
  base::Status CommandDevice(const std::string&, world::DeviceCommand) override {
    return Refused();
  }
  base::Result<std::shared_ptr<simulation::MountedSensor>> Mounted(
      const std::string&) const override {
    return base::Fail(Refused().error());
  }

  world::DriveCommand command() const {
    const std::lock_guard lock(mutex_);
    return command_;
  }
  std::pair<int, world::JointCommand> joint_command() const {
    const std::lock_guard lock(mutex_);
    return joint_command_;
  }

 private:
  const std::string name_ = kAvatar;
  const std::vector<model::Joint> joints_ = RobotModel().joints;
  mutable std::mutex mutex_;
  world::DriveCommand command_;
  std::pair<int, world::JointCommand> joint_command_{-1, {}};
};

ScriptedSimulation::ScriptedSimulation(std::string name, int robots)
    : floor_(std::make_shared<model::Model>(FloorModel())),
      crate_(std::make_shared<model::Model>(CrateModel())),
      robot_model_(std::make_shared<model::Model>(RobotModel())),
      avatar_(std::make_shared<Avatar>()),
      robots_(robots) {
  specification_.name = std::move(name);
  specification_.world = std::make_shared<model::WorldDescription>(ArenaDescription());
  sensing::AddBuiltInSensors(sensor_types_);
  GSV_CHECK(sensor_types_.Add(GradientCameraType()));
  PlaceAll();
}

void ScriptedSimulation::PlaceAll() {
  std::vector<world::Body> bodies;
  const auto add = [&](std::string name, std::shared_ptr<const model::Model> model,
                       const geometry::Pose& pose) -> world::Body& {
    world::Body body;
    body.name = std::move(name);
    body.kind = world::KindOf(*model, model->is_static, model::Movement::kPlanar);
    body.model = std::move(model);
    body.initial_pose = pose;
    return bodies.emplace_back(std::move(body));
  };
  add("floor", floor_, {});
  for (int i = 0; i < 4; ++i) {
    add("crate_" + std::to_string(i), crate_,
        geometry::PlanarPose(i & 1 ? 4 : -4, i & 2 ? 4 : -4, 0, 0));
  }
  for (int i = 0; i < robots_; ++i) add(RobotName(i), robot_model_, PoseOf(i, 0));
  add(kAvatar, robot_model_, geometry::PlanarPose(0, 0, 0, 0)).kind = world::BodyKind::kAvatar;
  layout_ = world::MakeLayout(layout_ ? layout_->version + 1 : 1, std::move(bodies),
                              specification_.world);
  PublishSnapshot();
}

void ScriptedSimulation::PublishSnapshot() {
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout = layout_;
  snapshot->state = world::InitialState(*layout_);
  snapshot->state.time = time_;
  snapshot->state.step = time_ / specification_.world->max_step_size;
  const double seconds = base::ToSeconds(time_);
  for (int i = 0; i < robots_; ++i) {
    const int body = layout_->Find(RobotName(i));
    snapshot->state.bodies[body].world_from_model = PoseOf(i, seconds);
    snapshot->state.bodies[body].distance = RadiusOf(i) * kTurnRate * seconds;
    const int joint = layout_->bodies[body].first_joint;
    snapshot->state.joint_positions[joint] = kWheelRate * seconds;
    snapshot->state.joint_positions[joint + 1] = kWheelRate * seconds;
  }
  for (const auto& [robot, drive] : drive_states_) {
    snapshot->state.bodies[layout_->Find(robot)].drive = drive;
  }
  snapshot_ = std::move(snapshot);
}

void ScriptedSimulation::Advance(base::SimTime time) {
  const std::lock_guard lock(mutex_);
  time_ += time;
  PublishSnapshot();
}

world::DriveCommand ScriptedSimulation::CommandOf(int robot) {
  return {RadiusOf(robot) * kTurnRate, 0, kTurnRate};
}

void ScriptedSimulation::SetDriveState(const std::string& robot, const world::DriveCommand& command,
                                       base::SimTime time) {
  const std::lock_guard lock(mutex_);
  drive_states_[robot].command = command;
  drive_states_[robot].command_time = time;
  PublishSnapshot();
}

// The snapshot of this step has two contacts of the bodies at the same point: one that begins, and
// one that began in an earlier step.
void ScriptedSimulation::Meet(const std::string& first, const std::string& second) {
  Advance(specification_.world->max_step_size);
  const std::lock_guard lock(mutex_);
  auto snapshot = std::make_shared<world::Snapshot>(*snapshot_);
  world::Contact contact;
  contact.first = layout_->Find(first);
  contact.second = layout_->Find(second);
  contact.point = snapshot->state.bodies[contact.first].world_from_model.position;
  contact.normal = {1, 0, 0};
  contact.began = true;
  contact.closing_speed = 0.5;
  world::Contact lasting = contact;
  lasting.began = false;
  snapshot->contacts = {contact, lasting};
  snapshot_ = snapshot;
  for (const auto& observer : observers_) observer->OnSnapshot(snapshot_);
}

void ScriptedSimulation::Time(const simulation::StepTimes& times) {
  const std::lock_guard lock(mutex_);
  for (const auto& observer : observers_) {
    if (observer->wants_times()) observer->OnTimes(times);
  }
}

void ScriptedSimulation::AddOneRobot() {
  const std::lock_guard lock(mutex_);
  ++robots_;
  PlaceAll();
}

void ScriptedSimulation::Mount(const std::string& robot, model::SensorDescription sensor) {
  const std::lock_guard lock(mutex_);
  mounted_[robot].push_back(std::move(sensor));
}

void ScriptedSimulation::AddEvent(const std::string& kind) {
  const std::lock_guard lock(mutex_);
  events_.push_back({snapshot_->state.step, time_, kind, "", "", nullptr});
}

void ScriptedSimulation::set_on_watch(std::function<base::Status(const std::string&)> on_watch) {
  const std::lock_guard lock(mutex_);
  on_watch_ = std::move(on_watch);
}

world::DriveCommand ScriptedSimulation::avatar_command() const { return avatar_->command(); }

std::pair<int, world::JointCommand> ScriptedSimulation::joint_command() const {
  return avatar_->joint_command();
}

base::Status ScriptedSimulation::ChangePhase(Phase phase, std::vector<Phase> from,
                                             const char* event) {
  const std::lock_guard lock(mutex_);
  if (std::find(from.begin(), from.end(), phase_) == from.end()) {
    return base::Fail(ErrorCode::kNotRunning, std::string("the simulation is ") +
                                                  simulation::ToString(phase_) + " and cannot be " +
                                                  event);
  }
  phase_ = phase;
  events_.push_back({snapshot_->state.step, time_, event, "", ""});
  changed_.notify_all();
  return {};
}

base::Status ScriptedSimulation::Start() {
  return ChangePhase(Phase::kRunning, {Phase::kCreated}, "started");
}
base::Status ScriptedSimulation::Pause() {
  return ChangePhase(Phase::kPaused, {Phase::kRunning}, "paused");
}
base::Status ScriptedSimulation::Resume() {
  return ChangePhase(Phase::kRunning, {Phase::kPaused}, "resumed");
}
base::Status ScriptedSimulation::Stop() {
  return ChangePhase(Phase::kStopped, {Phase::kCreated, Phase::kRunning, Phase::kPaused},
                     "stopped");
}
base::Status ScriptedSimulation::Reset() {
  const std::lock_guard lock(mutex_);
  phase_ = Phase::kCreated;
  time_ = base::SimTime(0);
  PublishSnapshot();
  changed_.notify_all();
  return {};
}
base::Status ScriptedSimulation::Step(std::int64_t count) {
  if (base::Status paused =
          ChangePhase(Phase::kPaused, {Phase::kCreated, Phase::kPaused}, "stepped");
      !paused) {
    return paused;
  }
  Advance(count * specification_.world->max_step_size);
  return {};
}
base::Status ScriptedSimulation::SetRealTimeFactor(double factor) {
  if (!(factor > 0)) return base::Fail(ErrorCode::kInvalidArgument, "the factor must be above 0");
  const std::lock_guard lock(mutex_);
  factor_ = factor;
  return {};
}
base::Status ScriptedSimulation::SetGravity(std::optional<double> z) {
  const std::lock_guard lock(mutex_);
  gravity_ = z;
  return {};
}
std::optional<double> ScriptedSimulation::gravity() const {
  const std::lock_guard lock(mutex_);
  return gravity_;
}
double ScriptedSimulation::real_time_factor() const {
  const std::lock_guard lock(mutex_);
  return factor_;
}
base::Status ScriptedSimulation::RunUntil(base::SimTime) { return Refused(); }
base::Status ScriptedSimulation::RunThrough(base::SimTime) { return Refused(); }

base::Result<std::vector<std::string>> ScriptedSimulation::AddRobots(
    std::vector<simulation::RobotSpecification>) {
  return base::Fail(Refused().error());
}
base::Status ScriptedSimulation::RemoveRobot(const std::string&) { return Refused(); }
base::Result<std::string> ScriptedSimulation::AddObject(simulation::ObjectSpecification) {
  return base::Fail(Refused().error());
}
base::Status ScriptedSimulation::RemoveObject(const std::string&) { return Refused(); }
base::Status ScriptedSimulation::PlaceBody(const std::string&, const geometry::Pose&, bool) {
  return Refused();
}
base::Status ScriptedSimulation::SetBehaviour(const std::string&,
                                              std::shared_ptr<simulation::BehaviourPort>) {
  return Refused();
}

base::Status ScriptedSimulation::CommandJoint(const std::string&, const std::string&,
                                              const world::JointCommand&) {
  return Refused();
}

simulation::SimulationStatus ScriptedSimulation::status() const {
  const std::lock_guard lock(mutex_);
  simulation::SimulationStatus status;
  status.name = specification_.name;
  status.phase = phase_;
  status.step = snapshot_->state.step;
  status.time = time_;
  status.step_size = specification_.world->max_step_size;
  status.target_factor = factor_;
  status.real_time_factor = phase_ == Phase::kRunning ? 1 : 0;
  status.events = events_.size();
  status.outputs = outputs_.size();
  for (std::size_t i = 0; i < layout_->bodies.size(); ++i) {
    const world::Body& body = layout_->bodies[i];
    if (!body.is_robot()) continue;
    simulation::RobotStatus robot;
    robot.name = body.name;
    robot.model = body.model->name;
    robot.behaviour = body.is_avatar() ? "" : "circle";
    robot.is_avatar = body.is_avatar();
    robot.phase =
        body.is_avatar() ? simulation::AgentPhase::kNone : simulation::AgentPhase::kRunning;
    robot.world_from_robot = snapshot_->state.bodies[i].world_from_model;
    robot.distance = snapshot_->state.bodies[i].distance;
    if (const auto set = motions_.find(robot.name); set != motions_.end()) {
      robot.motion = set->second;
    }
    status.robots.push_back(std::move(robot));
  }
  return status;
}

std::shared_ptr<const world::Snapshot> ScriptedSimulation::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

std::string ScriptedSimulation::state_hash() const {
  base::Hash hash;
  const auto latest = snapshot();
  world::AddToHash(*latest->layout, latest->state, hash);
  return hash.Hex();
}

Phase ScriptedSimulation::WaitForPhase(const std::vector<Phase>& phases,
                                       std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] {
    return std::find(phases.begin(), phases.end(), phase_) != phases.end();
  });
  return phase_;
}

std::shared_ptr<simulation::Agent> ScriptedSimulation::agent(const std::string& robot) const {
  const std::lock_guard lock(mutex_);
  const int body = layout_->Find(robot);
  // All robots share one agent; avatar_command() returns its commands.
  return body >= 0 && layout_->bodies[body].is_robot() ? avatar_ : nullptr;
}

base::Result<sensing::Reading> ScriptedSimulation::Watch(const std::string& robot,
                                                         const std::string& sensor) {
  std::function<base::Status(const std::string&)> on_watch;
  {
    const std::lock_guard lock(mutex_);
    on_watch = on_watch_;
  }
  if (on_watch) {
    if (base::Status allowed = on_watch(sensor); !allowed) return base::Fail(allowed.error());
  }
  for (const model::SensorDescription& description : sensors(robot)) {
    if (description.name != sensor) continue;
    const auto made = sensor_types_.Find(description.type)->create(description);
    if (!made) return base::Fail(made.error());
    const std::shared_ptr<const world::Snapshot> latest = snapshot();
    return (*made)->Sample({latest, latest->layout->Find(robot), 0, rays_});
  }
  return base::Fail(ErrorCode::kNotFound, "there is no sensor " + sensor);
}

std::vector<model::SensorDescription> ScriptedSimulation::sensors(const std::string& robot) const {
  const std::lock_guard lock(mutex_);
  std::vector<model::SensorDescription> sensors = robot_model_->sensors;
  const auto more = mounted_.find(robot);
  if (more != mounted_.end()) {
    sensors.insert(sensors.end(), more->second.begin(), more->second.end());
  }
  return sensors;
}

std::uint64_t ScriptedSimulation::sensor_changes() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t changes = 0;
  for (const auto& [robot, sensors] : mounted_) changes += sensors.size();
  return changes;
}

std::vector<simulation::Event> ScriptedSimulation::events(std::uint64_t first) const {
  const std::lock_guard lock(mutex_);
  const std::size_t begin = std::min<std::size_t>(first, events_.size());
  return {events_.begin() + static_cast<std::ptrdiff_t>(begin), events_.end()};
}

std::vector<simulation::Event> ScriptedSimulation::outputs(std::uint64_t first) const {
  const std::lock_guard lock(mutex_);
  const std::size_t begin = std::min<std::size_t>(first, outputs_.size());
  return {outputs_.begin() + static_cast<std::ptrdiff_t>(begin), outputs_.end()};
}

void ScriptedSimulation::Emit(std::string_view kind, const std::string& robot,
                              const std::string& detail) {
  const std::lock_guard lock(mutex_);
  const simulation::Event event{snapshot_->state.step, time_, std::string(kind), robot, detail, {}};
  (simulation::IsOutput(event) ? outputs_ : events_).push_back(event);
}

void ScriptedSimulation::SetExpectations(
    std::weak_ptr<const simulation::ExpectationSource> source) {
  const std::lock_guard lock(mutex_);
  expectations_ = std::move(source);
}

std::vector<simulation::ExpectationState> ScriptedSimulation::expectations() const {
  std::shared_ptr<const simulation::ExpectationSource> source;
  {
    const std::lock_guard lock(mutex_);
    source = expectations_.lock();
  }
  return source == nullptr ? std::vector<simulation::ExpectationState>() : source->states();
}

void ScriptedSimulation::SetMotion(const std::string& robot, const simulation::Motion& motion) {
  const std::lock_guard lock(mutex_);
  motions_[robot] = motion;
}

void ScriptedSimulation::AddObserver(std::shared_ptr<simulation::Observer> observer) {
  const std::lock_guard lock(mutex_);
  observers_.push_back(std::move(observer));
}
void ScriptedSimulation::RemoveObserver(const std::shared_ptr<simulation::Observer>& observer) {
  const std::lock_guard lock(mutex_);
  std::erase(observers_, observer);
}
std::size_t ScriptedSimulation::observers() const {
  const std::lock_guard lock(mutex_);
  return observers_.size();
}

}  // namespace gsv::gateway::testing
