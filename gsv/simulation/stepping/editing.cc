// Implements requests that change the bodies of a simulated world, and records these edits.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "gsv/simulation/editing/placement.h"
#include "gsv/simulation/stepping/stepping_simulation.h"
#include "gsv/world/station.h"

namespace gsv::simulation {
namespace {

// Wall-clock time limit within which behaviours in other processes must end their turn after a
// pause.
constexpr std::chrono::seconds kTurnTimeout{2};

base::Status CheckBehaviour(const BehaviourPort& behaviour, Mode mode, const std::string& robot) {
  if (mode != Mode::kLockstep || behaviour.time_managed()) return {};
  return base::Fail(
      base::ErrorCode::kBehaviour,
      "the behaviour \"" + behaviour.name() +
          "\" uses the wall clock, so lockstep would not wait for it; run in real time",
      robot);
}

base::Status CheckFinite(const geometry::Pose& pose, const std::string& body) {
  if (geometry::IsFinite(pose)) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument, "the pose is not finite", body);
}

base::Status CheckRobot(const RobotSpecification& robot, Mode mode) {
  const std::string where = robot.name.empty() ? robot.model->name : robot.name;
  if (!geometry::IsFinite(robot.world_from_robot)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the robot's pose is not finite", where);
  }
  if (robot.behaviour == nullptr || robot.allow_unmanaged) return {};
  return CheckBehaviour(*robot.behaviour, mode, where);
}

// Returns the file of a model, or the model's name if it has no file.
std::string SourceOf(const model::Model& model) {
  return model.source.empty() ? model.name : model.source;
}

Edit EditOf(const RobotSpecification& robot) {
  Edit edit;
  edit.kind = robot.is_avatar ? Edit::Kind::kAddAvatar : Edit::Kind::kAddRobot;
  edit.body = robot.name;
  edit.model = SourceOf(*robot.model);
  if (robot.behaviour != nullptr) edit.behaviour = robot.behaviour->name();
  edit.movement = robot.movement;
  edit.drive = robot.drive;
  edit.world_from_body = robot.world_from_robot;
  edit.on_ground = robot.on_ground;
  return edit;
}

Edit EditOf(const ObjectSpecification& object, const std::string& name) {
  Edit edit;
  edit.kind = Edit::Kind::kAddObject;
  edit.body = name;
  if (object.model != nullptr) {
    edit.model = SourceOf(*object.model);
  } else {
    edit.copy_of = object.copy_of;
  }
  edit.world_from_body = object.world_from_object;
  edit.on_ground = object.on_ground;
  return edit;
}

// Returns the shortest text that is parsed as the same number.
std::string ShortestText(double number) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number);
  return {text, end};
}

Edit RemovalOf(const std::string& name) {
  Edit edit;
  edit.kind = Edit::Kind::kRemove;
  edit.body = name;
  return edit;
}

}  // namespace

void SteppingSimulation::AwaitTurns() const {
  SimulationLock lock(*shared_);
  if (shared_->mode != Mode::kLockstep || run_.phase() != Phase::kPaused) return;
  shared_->changed.wait_for(lock.inner(), kTurnTimeout, [this]() GSV_REQUIRES(simulation_mutex) {
    return shared_->running == 0 && !shared_->has_turns();
  });
}

base::Status SteppingSimulation::CheckMayEdit(const WorldGuard& guard) const {
  if (!guard.is_held()) return RefuseStuck();
  const SimulationLock lock(*shared_);
  return run_.Require({Phase::kCreated, Phase::kPaused}, "edit its world");
}

void SteppingSimulation::AssignBodies() {
  const SimulationLock lock(*shared_);
  agents_.AssignBodies(*world_.layout());
}

void SteppingSimulation::RecordEdit(Edit edit, const char* event, const std::string& detail) {
  edit.step = world_.state().step;
  edit.time = world_.state().time;
  {
    const SimulationLock lock(*shared_);
    edit.kind == Edit::Kind::kCommand ? run_.MarkWorldChanged() : run_.MarkEdited();
    edit.halt = run_.run();
    edit.moment = run_.MomentOfEdit(shared_->running == 0 && !shared_->has_turns());
  }
  const std::string body = edit.body;
  events_.Emit(event, body, detail, std::make_shared<const Edit>(std::move(edit)));
}

bool SteppingSimulation::was_edited() const {
  const SimulationLock lock(*shared_);
  return run_.was_edited();
}

base::Result<std::vector<std::string>> SteppingSimulation::AddRobots(
    std::vector<RobotSpecification> robots) {
  const base::MutexLock control(control_mutex_);
  for (RobotSpecification& robot : robots) {
    if (auto ok = CheckRobot(robot, specification_.mode); !ok) return base::Fail(ok.error());
    auto model = robot_models_.Find(robot.model, robot.drive, robot.is_avatar);
    if (!model) {
      model.error().where = robot.name.empty() ? robot.model->name : robot.name;
      return base::Fail(model.error());
    }
    robot.model = *std::move(model);
  }
  AwaitTurns();
  if (auto ok = PlaceRobots(robots); !ok) return base::Fail(ok.error());
  std::vector<std::string> names;
  names.reserve(robots.size());
  for (const RobotSpecification& robot : robots) names.push_back(robot.name);
  std::vector<AgentPopulation::AgentPtr> with_behaviour;
  for (const RobotSpecification& robot : robots) {
    if (robot.behaviour == nullptr) continue;
    auto agent = FindAgent(robot.name);
    if (auto ok = robot.behaviour->Init(agent); !ok) {
      (void)RemoveRobots(names);  // AddRobots() returns the error of Init()
      return base::Fail(ok.error());
    }
    with_behaviour.push_back(std::move(agent));
  }
  const SimulationLock lock(*shared_);
  if (run_.phase() == Phase::kStarting || run_.is_running())
    life_cycle_.StartBehaviours(with_behaviour);
  return names;
}

base::Status SteppingSimulation::PlaceRobots(std::vector<RobotSpecification>& robots) {
  const WorldGuard world_guard(world_.lock());
  if (!world_guard.is_held()) return RefuseStuck();
  if (auto ok = editor_.AddRobots(robots); !ok) return ok;
  for (const RobotSpecification& robot : robots) {
    RecordEdit(EditOf(robot), robot.is_avatar ? "avatar_added" : "robot_added");
  }
  const SimulationLock lock(*shared_);
  for (const RobotSpecification& robot : robots) {
    agents_.Add(robot.name, robot.model, robot.is_avatar, robot.behaviour);
  }
  agents_.AssignBodies(*world_.layout());
  return {};
}

base::Status SteppingSimulation::RemoveRobot(const std::string& name) {
  const base::MutexLock control(control_mutex_);
  if (const auto found = RequireAgent(name); !found) return base::Fail(found.error());
  const auto snapshot = shared_->history.latest();
  const int body = snapshot->layout->Find(name);
  if (body >= 0 && world::IsStation(snapshot->layout->bodies[static_cast<std::size_t>(body)])) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the body is not a robot; remove it as an object", name);
  }
  AwaitTurns();
  return RemoveRobots({name});
}

base::Status SteppingSimulation::RemoveRobots(const std::vector<std::string>& names) {
  const WorldGuard world_guard(world_.lock());
  if (!world_guard.is_held()) return RefuseStuck();
  {
    const SimulationLock lock(*shared_);
    for (const std::string& name : names) agents_.Remove(name);
  }
  // No step is taken while the world's lock is held. The simulation's lock is not held here, so
  // other threads can look up agents without waiting for the engine.
  (void)editor_.Remove(names);  // removing bodies cannot fail
  AssignBodies();
  shared_->changed.notify_all();
  for (const std::string& name : names) RecordEdit(RemovalOf(name), "robot_removed");
  return {};
}

void SteppingSimulation::AddStation(const std::string& name) {
  const world::Layout& layout = *world_.layout();
  const world::Body& body = layout.bodies[static_cast<std::size_t>(layout.Find(name))];
  if (!world::IsStation(body)) return;
  const SimulationLock lock(*shared_);
  agents_.Add(name, body.model, false, nullptr);
}

base::Result<std::string> SteppingSimulation::AddObject(ObjectSpecification object) {
  const base::MutexLock control(control_mutex_);
  if (auto ok = CheckFinite(object.world_from_object, object.name); !ok)
    return base::Fail(ok.error());
  AwaitTurns();
  const WorldGuard world_guard(world_.lock());
  if (auto ok = CheckMayEdit(world_guard); !ok) return base::Fail(ok.error());
  auto name = editor_.AddObject(object);
  if (!name) return name;
  AddStation(*name);
  AssignBodies();
  RecordEdit(EditOf(object, *name), "object_added", "at " + PlaceText(world_.PoseOf(*name)));
  return name;
}

base::Status SteppingSimulation::RemoveObject(const std::string& name) {
  const base::MutexLock control(control_mutex_);
  AwaitTurns();
  const WorldGuard world_guard(world_.lock());
  if (auto ok = CheckMayEdit(world_guard); !ok) return base::Fail(ok.error());
  if (auto ok = editor_.RemoveObject(name); !ok) return ok;
  {
    const SimulationLock lock(*shared_);
    agents_.Remove(name);  // a station has an agent
  }
  AssignBodies();
  RecordEdit(RemovalOf(name), "object_removed");
  return {};
}

base::Status SteppingSimulation::PlaceBody(const std::string& name,
                                           const geometry::Pose& world_from_body, bool on_ground) {
  const base::MutexLock control(control_mutex_);
  if (auto ok = CheckFinite(world_from_body, name); !ok) return ok;
  AwaitTurns();
  const WorldGuard world_guard(world_.lock());
  if (auto ok = CheckMayEdit(world_guard); !ok) return base::Fail(ok.error());
  if (auto ok = editor_.Place(name, world_from_body, on_ground); !ok) return ok;
  Edit edit;
  edit.kind = Edit::Kind::kPlace;
  edit.body = name;
  edit.world_from_body = world_from_body;
  edit.on_ground = on_ground;
  RecordEdit(std::move(edit), "body_placed", "at " + PlaceText(world_.PoseOf(name)));
  return {};
}

base::Status SteppingSimulation::CommandJoint(const std::string& body, const std::string& joint,
                                              const world::JointCommand& command) {
  const WorldGuard world_guard(world_.lock());
  if (!world_guard.is_held()) return RefuseStuck();
  const world::Layout& layout = *world_.layout();
  const int index = layout.Find(body);
  const world::Body* const moved =
      index < 0 ? nullptr : &layout.bodies[static_cast<std::size_t>(index)];
  if (moved == nullptr || !(moved->is_rigid() || moved->is_robot())) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "the simulation has no movable body \"" + body + "\"", specification_.name);
  }
  const int number = model::FindJoint(moved->model->joints, joint);
  if (number < 0) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no joint \"" + joint + "\"", body);
  }
  if (auto ok = world::CheckJointCommand(*moved, number, command); !ok) return ok;
  world::CommandJoint(layout, index, number, command, world_.state());
  events_.Emit("joint_commanded", body, joint);
  return {};
}

base::Status SteppingSimulation::SetGravity(std::optional<double> z) {
  if (z && !std::isfinite(*z)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "gravity must be finite",
                      specification_.name);
  }
  const base::MutexLock control(control_mutex_);
  AwaitTurns();
  const WorldGuard world_guard(world_.lock());
  if (auto ok = CheckMayEdit(world_guard); !ok) return ok;
  const geometry::Vector3 gravity = z ? geometry::Vector3{0, 0, *z} : specification_.world->gravity;
  if (auto ok = editor_.SetGravity(gravity); !ok) return ok;
  Edit edit;
  edit.kind = Edit::Kind::kCommand;
  edit.command = "set_gravity";
  if (z) edit.arguments["z"] = ShortestText(*z);
  RecordEdit(std::move(edit), "gravity_set", "z " + ShortestText(gravity.z) + " m/s²");
  return {};
}

base::Status SteppingSimulation::SetBehaviour(const std::string& robot,
                                              std::shared_ptr<BehaviourPort> behaviour) {
  const base::MutexLock control(control_mutex_);
  const auto found = RequireAgent(robot);
  if (!found) return base::Fail(found.error());
  if (auto ok = CheckBehaviour(*behaviour, specification_.mode, robot); !ok) return ok;
  {
    const SimulationLock lock(*shared_);
    if (auto ok = run_.Require({Phase::kCreated}, "change a behaviour"); !ok) return ok;
    agents_.SetBehaviour(**found, behaviour);
  }
  const base::Status status = behaviour->Init(*found);
  if (!status) {
    const SimulationLock lock(*shared_);
    agents_.SetBehaviour(**found, nullptr);
  }
  return status;
}

}  // namespace gsv::simulation
