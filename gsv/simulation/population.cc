// Who stands in a simulated world: robots come, go and are given behaviours.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>

#include "gsv/sensing/rays/ground.h"
#include "gsv/simulation/limits.h"
#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {
namespace {

// m: two bodies that are placed closer than touching by more than this are in each other.
constexpr double kPlacingTolerance = 1e-3;

base::Status CheckBehaviour(const BehaviourPort& behaviour, Mode mode, const std::string& robot) {
  if (mode != Mode::kLockstep || behaviour.time_managed()) return {};
  return base::Fail(base::ErrorCode::kBehaviour,
                    "the behaviour \"" + behaviour.name() +
                        "\" tells the time by the wall clock, so lockstep would not wait for it; "
                        "run in real time",
                    robot);
}

base::Status CheckRobot(const RobotSpecification& robot, Mode mode) {
  const std::string where = robot.name.empty() ? robot.model->name : robot.name;
  if (!geometry::IsFinite(robot.world_from_robot)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the robot's pose is not finite", where);
  }
  if (!robot.model->drive) {
    return base::Fail(
        base::ErrorCode::kBadModel,
        "the model \"" + robot.model->name +
            "\" has no drive that gsv knows, so it cannot be a robot; add a plugin such as "
            "gz::sim::systems::DiffDrive to it",
        where);
  }
  if (robot.behaviour == nullptr || robot.allow_unmanaged) return {};
  return CheckBehaviour(*robot.behaviour, mode, where);
}

Edit EditOf(const RobotSpecification& robot) {
  Edit edit;
  edit.kind = robot.is_avatar ? Edit::Kind::kAddAvatar : Edit::Kind::kAddRobot;
  edit.body = robot.name;
  edit.model = SourceOf(*robot.model);
  if (robot.behaviour != nullptr) edit.behaviour = robot.behaviour->name();
  edit.movement = robot.movement;
  edit.world_from_body = robot.world_from_robot;
  edit.on_ground = robot.on_ground;
  return edit;
}

// At its initial pose, as somebody has put it down there by hand.
void PutAtRest(const world::Layout& layout, int body, world::State& state) {
  world::BodyState& placed = state.bodies[body];
  placed.world_from_model = layout.bodies[body].initial_pose;
  placed.linear_velocity = placed.angular_velocity = {};
  placed.drive.actual = {};
  placed.in_contact = false;
  const auto first = state.joint_velocities.begin() + layout.bodies[body].first_joint;
  std::fill_n(first, layout.bodies[body].model->joints.size(), 0.0);
}

}  // namespace

std::string PlaceText(const geometry::Pose& pose) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.3g, %.3g)", pose.position.x, pose.position.y);
  return text;
}

std::string SourceOf(const model::Model& model) {
  return model.source.empty() ? model.name : model.source;
}

base::Status SteppingSimulation::CheckName(const std::string& name) const {
  if (name.size() <= 128 && name.find('/') == std::string::npos) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "a name has 1 to 128 characters and no \"/\"", name);
}

base::Status SteppingSimulation::NameRobots(std::vector<RobotSpecification>& robots) const {
  std::map<std::string, int> taken;
  for (const world::Body& body : layout_->bodies) taken[body.name] = 1;
  for (const RobotSpecification& robot : robots) {
    if (robot.name.empty()) continue;
    if (auto ok = CheckName(robot.name); !ok) return ok;
    if (++taken[robot.name] > 1) {
      return base::Fail(base::ErrorCode::kInvalidArgument, "a body of that name is there already",
                        robot.name);
    }
  }
  std::map<std::string, int> next_number;  // by model: a crowd need not count from two each time
  for (RobotSpecification& robot : robots) {
    if (!robot.name.empty()) continue;
    robot.name = robot.model->name;
    int& number = next_number.try_emplace(robot.name, 2).first->second;
    while (taken.contains(robot.name)) {
      robot.name = robot.model->name + "_" + std::to_string(number++);
    }
    taken[robot.name] = 1;
  }
  return {};
}

geometry::Pose SteppingSimulation::StandingPose(const model::Model& model, geometry::Pose pose,
                                                int own) const {
  const auto may_carry = [this, own](int body) {
    return body != own && !layout_->bodies[body].is_robot();
  };
  const auto solids = shared_->rays.At(shared_->history.latest());
  const double floor = sensing::FloorHeight(*solids, pose.position.x, pose.position.y, may_carry);
  pose.position.z = floor - model::LowestPoint(model, pose.orientation);
  return pose;
}

namespace {

base::Status CheckRoomFor(std::size_t more, const std::vector<world::Body>& bodies) {
  const std::size_t most = ProcessLimits().robots;
  const auto there = static_cast<std::size_t>(std::count_if(
      bodies.begin(), bodies.end(), [](const world::Body& body) { return body.is_robot(); }));
  if (there <= most && more <= most - there) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "a simulation holds at most " + std::to_string(most) +
                        " robots here; remove some first, or raise --limit robots");
}

}  // namespace

base::Status SteppingSimulation::PlaceRobots(std::vector<RobotSpecification>& robots) {
  const auto world_lock = LockWorld();
  if (!world_lock) return RefuseStuck();
  if (auto ok = NameRobots(robots); !ok) return ok;
  std::vector<world::Body> bodies = layout_->bodies;
  if (auto ok = CheckRoomFor(robots.size(), bodies); !ok) return ok;
  std::vector<std::string> added;
  for (const RobotSpecification& robot : robots) {
    world::Body body;
    body.name = robot.name;
    body.model = robot.model;
    body.initial_pose = robot.on_ground ? StandingPose(*robot.model, robot.world_from_robot)
                                        : robot.world_from_robot;
    body.kind = robot.is_avatar ? world::BodyKind::kAvatar
                                : world::KindOf(*robot.model, false,
                                                robot.movement.value_or(robot.model->movement));
    bodies.push_back(std::move(body));
    added.push_back(robot.name);
  }
  if (auto ok = ChangeLayout(std::move(bodies), added); !ok) return ok;
  for (const RobotSpecification& robot : robots) {
    Tell(EditOf(robot), robot.is_avatar ? "avatar_added" : "robot_added");
  }
  const std::lock_guard lock(shared_->mutex);
  for (const RobotSpecification& robot : robots) {
    auto agent = std::make_shared<RobotAgent>(robot.name, robot.model, robot.is_avatar, shared_);
    agent->SetBehaviour(robot.behaviour);
    if (robot.behaviour != nullptr && robot.behaviour->local() != nullptr) has_hosted_ = true;
    agent->StartDevices();
    agents_.emplace(robot.name, std::move(agent));
  }
  IndexAgents();
  return {};
}

base::Status SteppingSimulation::ChangeLayout(std::vector<world::Body> bodies,
                                              const std::vector<std::string>& placed) {
  const std::uint32_t version = layout_->version + 1;
  auto layout = world::MakeLayout(version, std::move(bodies), layout_->description);
  world::State state = CarryOver(*layout);
  CarryOverDevices(*layout, placed, state);
  auto status = SetEngineLayout(layout, state);
  for (const std::string& name : placed) PutAtRest(*layout, layout->Find(name), state);
  if (status && !placed.empty()) status = MakeRoom(*layout, placed, state);
  if (!status) {
    if (const auto back = SetEngineLayout(layout_, state_); !back) return back;
    return status;
  }
  MoveDevices(*layout, state.time, state);
  // A robot starts where there was room for it, also after a reset; one that was put elsewhere in
  // mid-run, where it did.
  std::vector<world::Body> settled = layout->bodies;
  for (const std::string& name : placed) {
    const int body = layout->Find(name);
    const bool starts_here = state.step == 0 || settled[body].is_static();
    const int old = starts_here ? -1 : layout_->Find(name);
    settled[body].initial_pose =
        old >= 0 ? layout_->bodies[old].initial_pose : state.bodies[body].world_from_model;
  }
  layout_ = world::MakeLayout(version, std::move(settled), layout->description);
  state_ = std::move(state);
  if (auto ok = SetEngineLayout(layout_, state_); !ok) return ok;
  wheel_odometry_.SetLayout(*layout_);
  shared_->history.Restart(
      std::make_shared<world::Snapshot>(world::Snapshot{layout_, state_, {}, {}, {}}));
  return {};
}

base::Status SteppingSimulation::SetEngineLayout(const std::shared_ptr<const world::Layout>& layout,
                                                 const world::State& state) {
  return attachments_.SetLayout(layout, state, *engine_);
}

world::State SteppingSimulation::CarryOver(const world::Layout& layout) const {
  world::State state = world::InitialState(layout);
  state.step = state_.step;
  state.time = state_.time;
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    const world::Body& body = layout.bodies[i];
    const int old = layout_->Find(body.name);
    if (old < 0) continue;
    state.bodies[i] = state_.bodies[old];
    const world::Body& old_body = layout_->bodies[old];
    std::copy_n(state_.joint_positions.begin() + old_body.first_joint, body.model->joints.size(),
                state.joint_positions.begin() + body.first_joint);
    std::copy_n(state_.joint_velocities.begin() + old_body.first_joint, body.model->joints.size(),
                state.joint_velocities.begin() + body.first_joint);
    if (state_.joint_commands.empty()) continue;
    state.joint_commands.resize(static_cast<std::size_t>(layout.joint_count));
    std::copy_n(state_.joint_commands.begin() + old_body.first_joint, body.model->joints.size(),
                state.joint_commands.begin() + body.first_joint);
  }
  state.devices = state_.devices;
  return state;
}

int SteppingSimulation::Intruded(const world::Layout& layout, const world::State& state, int body) {
  int found = -1;
  for (const world::Contact& overlap : engine_->OverlapsOf(state, body, kPlacingTolerance)) {
    found = overlap.first == body ? overlap.second : overlap.first;
    if (layout.bodies[found].is_robot()) return found;  // that is the harder case: say it first
  }
  return found;
}

base::Status SteppingSimulation::MakeRoom(const world::Layout& layout,
                                          const std::vector<std::string>& placed,
                                          world::State& state) {
  // Most of a crowd stand free, and who steps aside steps into nobody.
  std::vector<bool> stands_free(layout.bodies.size(), true);
  for (const world::Contact& overlap : engine_->Overlaps(state, kPlacingTolerance)) {
    stands_free[overlap.first] = stands_free[overlap.second] = false;
  }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::string& name = placed[i];
    const int body = layout.Find(name);
    const bool is_robot = layout.bodies[body].is_robot();
    if (is_robot && stands_free[body]) continue;
    const geometry::Pose wanted = layout.bodies[body].initial_pose;
    const int intruded = Intruded(layout, state, body);
    if (intruded < 0) continue;
    // Of two newcomers at one place the second is the one too many.
    const auto rest = placed.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (std::find(rest, placed.end(), layout.bodies[intruded].name) != placed.end()) continue;
    // What stands more outside of a wall than in it is put before it.
    if (is_robot && !layout.bodies[intruded].is_robot() && StepAside(layout, body, state)) {
      AddEvent("robot_moved", name,
               "starts at " + PlaceText(state.bodies[body].world_from_model) + ", since at " +
                   PlaceText(wanted) + " it would stand in \"" + layout.bodies[intruded].name +
                   "\"");
      continue;
    }
    return base::Fail(base::ErrorCode::kBadModel,
                      "there is no room at " + PlaceText(wanted) + ": it would stand in \"" +
                          layout.bodies[intruded].name + "\"; choose another place",
                      name);
  }
  return {};
}

bool SteppingSimulation::StepAside(const world::Layout& layout, int body, world::State& state) {
  constexpr double kStride = 0.01;  // m
  constexpr int kDirections = 16;
  const geometry::Pose wanted = layout.bodies[body].initial_pose;
  const double farthest = model::FootprintRadius(*layout.bodies[body].model);
  const auto is_free_at = [&](double distance, double direction) {
    geometry::Pose& pose = state.bodies[body].world_from_model;
    pose = wanted;
    pose.position.x += distance * std::cos(direction);
    pose.position.y += distance * std::sin(direction);
    return Intruded(layout, state, body) < 0;
  };
  for (double distance = kStride; distance <= farthest; distance += kStride) {
    for (int i = 0; i < kDirections; ++i) {
      const double direction = 2 * std::numbers::pi * i / kDirections;
      // Not just free of the wall, but with room to turn away from it.
      if (is_free_at(distance, direction) && is_free_at(distance + 2 * kStride, direction)) {
        return true;
      }
    }
  }
  return false;
}

void SteppingSimulation::IndexAgents() {
  for (const auto& [name, agent] : agents_) agent->SetBody(layout_->Find(name));
}

base::Result<std::vector<std::string>> SteppingSimulation::AddRobots(
    std::vector<RobotSpecification> robots) {
  const std::lock_guard control(control_mutex_);
  for (const RobotSpecification& robot : robots) {
    if (auto ok = CheckRobot(robot, specification_.mode); !ok) return base::Fail(ok.error());
  }
  AwaitTurns();
  if (auto ok = PlaceRobots(robots); !ok) return base::Fail(ok.error());
  std::vector<std::string> names;
  names.reserve(robots.size());
  for (const RobotSpecification& robot : robots) names.push_back(robot.name);
  std::vector<AgentPtr> with_behaviour;
  for (const RobotSpecification& robot : robots) {
    if (robot.behaviour == nullptr) continue;
    const AgentPtr agent = FindAgent(robot.name);
    if (auto ok = robot.behaviour->Init(agent); !ok) {
      (void)RemoveFromWorld(names);  // what went wrong first is told
      return base::Fail(ok.error());
    }
    with_behaviour.push_back(agent);
  }
  const std::lock_guard lock(shared_->mutex);
  if (shared_->phase == Phase::kStarting || shared_->phase == Phase::kRunning)
    StartAgents(with_behaviour);
  return names;
}

base::Status SteppingSimulation::RemoveFromWorld(const std::vector<std::string>& names) {
  const auto world_lock = LockWorld();
  if (!world_lock) return RefuseStuck();
  std::vector<world::Body> bodies = layout_->bodies;
  std::erase_if(bodies, [&](const world::Body& body) {
    return std::find(names.begin(), names.end(), body.name) != names.end();
  });
  Lock lock(shared_->mutex);
  for (const std::string& name : names) {
    const auto it = agents_.find(name);
    it->second->MarkGone();
    shared_->sleepers.Remove(it->second.get());
    std::erase(shared_->commanded, it->second.get());
    std::erase(shared_->ready, it->second.get());
    if (const auto& behaviour = it->second->behaviour(); behaviour != nullptr) {
      caller_.Post(name, [behaviour] {
        (void)behaviour->Stop();
        behaviour->Destroy();
      });
    }
    agents_.erase(it);
  }
  (void)ChangeLayout(std::move(bodies), {});  // fewer bodies always fit
  IndexAgents();
  shared_->changed.notify_all();
  lock.unlock();
  for (const std::string& name : names) {
    Edit edit;
    edit.kind = Edit::Kind::kRemove;
    edit.body = name;
    Tell(std::move(edit), "robot_removed");
  }
  return {};
}

base::Status SteppingSimulation::RemoveRobot(const std::string& name) {
  const std::lock_guard control(control_mutex_);
  if (FindAgent(name) == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no robot \"" + name + "\"",
                      specification_.name);
  }
  AwaitTurns();
  return RemoveFromWorld({name});
}

base::Status SteppingSimulation::CommandJoint(const std::string& body, const std::string& joint,
                                              const world::JointCommand& command) {
  const auto world_lock = LockWorld();
  if (!world_lock) return RefuseStuck();
  const int index = layout_->Find(body);
  if (index < 0 || !(layout_->bodies[index].is_rigid() || layout_->bodies[index].is_robot())) {
    return base::Fail(base::ErrorCode::kNotFound, "nothing moves a body \"" + body + "\"",
                      specification_.name);
  }
  const auto& joints = layout_->bodies[index].model->joints;
  const auto found = std::find_if(joints.begin(), joints.end(),
                                  [&](const model::Joint& j) { return j.name == joint; });
  if (found == joints.end()) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no joint \"" + joint + "\"", body);
  }
  const int number = static_cast<int>(found - joints.begin());
  if (auto ok = world::CheckJointCommand(layout_->bodies[index], number, command); !ok) return ok;
  world::CommandJoint(*layout_, index, number, command, state_);
  AddEvent("joint_commanded", body, joint);
  return {};
}

base::Status SteppingSimulation::SetBehaviour(const std::string& robot,
                                              std::shared_ptr<BehaviourPort> behaviour) {
  const std::lock_guard control(control_mutex_);
  const AgentPtr found = FindAgent(robot);
  if (found == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no robot \"" + robot + "\"",
                      specification_.name);
  }
  if (auto ok = CheckBehaviour(*behaviour, specification_.mode, robot); !ok) return ok;
  {
    const std::lock_guard lock(shared_->mutex);
    if (auto ok = RefuseUnless({Phase::kCreated}, "change a behaviour"); !ok) return ok;
    found->SetBehaviour(behaviour);
    if (behaviour->local() != nullptr) has_hosted_ = true;
  }
  const base::Status status = behaviour->Init(found);
  if (!status) {
    const std::lock_guard lock(shared_->mutex);
    found->SetBehaviour(nullptr);
  }
  return status;
}

}  // namespace gsv::simulation
