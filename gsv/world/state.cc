#include "gsv/world/state.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gsv/base/check.h"
#include "gsv/model/script.h"

namespace gsv::world {
namespace {

void Add(const geometry::Vector3& v, base::Hash& hash) {
  hash.Add(v.x), hash.Add(v.y), hash.Add(v.z);
}

void Add(const DriveCommand& command, base::Hash& hash) {
  hash.Add(command.linear), hash.Add(command.lateral), hash.Add(command.angular);
}

void Add(const BodyState& body, base::Hash& hash) {
  const geometry::Quaternion& q = body.world_from_model.orientation;
  Add(body.world_from_model.position, hash);
  hash.Add(q.w), hash.Add(q.x), hash.Add(q.y), hash.Add(q.z);
  Add(body.linear_velocity, hash);
  Add(body.angular_velocity, hash);
  Add(body.drive.command, hash);
  hash.Add(static_cast<std::int64_t>(body.drive.command_time.count()));
  Add(body.drive.actual, hash);
  const geometry::PlanarPosition& place = body.odometry.place;
  hash.Add(place.x), hash.Add(place.y), hash.Add(place.cosine), hash.Add(place.sine);
  hash.Add(body.odometry.linear), hash.Add(body.odometry.angular);
  hash.Add(body.distance);
  if (body.since.count() != 0) hash.Add(static_cast<std::int64_t>(body.since.count()));
  hash.Add(body.collisions);
  hash.Add(std::uint64_t{body.in_contact});
}

JointCommand::Kind KindOf(const model::JointTarget& target) {
  switch (target.kind) {
    case model::JointTarget::Kind::kPosition:
      return JointCommand::Kind::kPosition;
    case model::JointTarget::Kind::kVelocity:
      return JointCommand::Kind::kVelocity;
    case model::JointTarget::Kind::kEffort:
      return JointCommand::Kind::kEffort;
  }
  return JointCommand::Kind::kNone;
}

}  // namespace

State InitialState(const Layout& layout) {
  State state;
  state.bodies.resize(layout.bodies.size());
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    state.bodies[i].world_from_model = layout.bodies[i].initial_pose;
  }
  state.joint_positions.assign(layout.joint_count, 0.0);
  state.joint_velocities.assign(layout.joint_count, 0.0);
  for (const Body& body : layout.bodies) {
    std::copy(body.model->start_positions.begin(), body.model->start_positions.end(),
              state.joint_positions.begin() + body.first_joint);
  }
  if (std::any_of(layout.bodies.begin(), layout.bodies.end(),
                  [](const Body& body) { return body.is_pedestrian(); })) {
    state.goals.assign(layout.bodies.size(), 0);
  }
  for (const Body& body : layout.bodies) {
    if (!body.is_actor() || body.model->script->animation == nullptr) continue;
    const model::Animation& animation = *body.model->script->animation;
    std::copy_n(animation.positions.begin(), animation.joint_count,
                state.joint_positions.begin() + body.first_joint);
  }
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    if (!layout.bodies[i].is_rigid()) continue;
    for (const model::JointTarget& target : layout.bodies[i].model->joint_targets) {
      CommandJoint(layout, static_cast<int>(i), target.joint, {KindOf(target), target.value},
                   state);
    }
  }
  return state;
}

bool IsOfDrive(const model::Model& model, int joint) {
  if (!model.drive) return false;
  const model::Drive& drive = *model.drive;
  const auto holds = [joint](const std::vector<int>& joints) {
    return std::find(joints.begin(), joints.end(), joint) != joints.end();
  };
  return holds(drive.left_wheels) || holds(drive.right_wheels) || holds(drive.steered);
}

base::Status CheckJointCommand(const Body& body, int joint, const JointCommand& command) {
  using base::ErrorCode;
  if (joint < 0 || joint >= static_cast<int>(body.model->joints.size())) {
    return base::Fail(ErrorCode::kNotFound, "there is no joint number " + std::to_string(joint),
                      body.name);
  }
  const model::Joint& which = body.model->joints[static_cast<std::size_t>(joint)];
  const std::string place = body.name + "/" + which.name;
  if (!std::isfinite(command.value)) {
    return base::Fail(ErrorCode::kInvalidArgument, "a joint's command must be finite", place);
  }
  if (!model::TakesCommands(which.kind)) {
    return base::Fail(ErrorCode::kInvalidArgument, "fixed and ball joints take no commands", place);
  }
  if (which.mimic) {
    const auto leader = static_cast<std::size_t>(which.mimic->leader);
    return base::Fail(
        ErrorCode::kInvalidArgument,
        "this joint follows " + body.model->joints[leader].name + "; command that joint instead",
        place);
  }
  if (body.is_rigid()) return {};
  if (!body.is_robot()) {
    return base::Fail(
        ErrorCode::kInvalidArgument,
        "joint commands need a robot or a body with rigid-body dynamics; this body is neither",
        place);
  }
  if (IsOfDrive(*body.model, joint)) {
    return base::Fail(ErrorCode::kInvalidArgument, "the robot's drive controls this joint", place);
  }
  if (command.kind == JointCommand::Kind::kEffort) {
    return base::Fail(
        ErrorCode::kInvalidArgument,
        "effort commands require rigid-body dynamics: run the robot with --movement " + body.name +
            "=rigid",
        place);
  }
  return {};
}

void CommandJoint(const Layout& layout, int body, int joint, const JointCommand& command,
                  State& state) {
  state.joint_commands.resize(static_cast<std::size_t>(layout.joint_count));
  state.joint_commands[static_cast<std::size_t>(layout.bodies[body].first_joint + joint)] = command;
}

void AddToHash(const Layout& layout, const State& state, base::Hash& hash) {
  GSV_CHECK(layout.bodies.size() == state.bodies.size());
  hash.Add(state.step);
  hash.Add(static_cast<std::int64_t>(state.time.count()));
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    hash.Add(std::string_view(layout.bodies[i].name));
    Add(state.bodies[i], hash);
  }
  for (const double q : state.joint_positions) hash.Add(q);
  for (const double qd : state.joint_velocities) hash.Add(qd);
  // Only commands are added. So a list in which no joint has a command has the hash of an empty
  // list.
  for (std::size_t i = 0; i < state.joint_commands.size(); ++i) {
    const JointCommand& command = state.joint_commands[i];
    if (command.kind == JointCommand::Kind::kNone) continue;
    hash.Add(static_cast<std::uint64_t>(i));
    hash.Add(static_cast<std::uint64_t>(command.kind));
    hash.Add(command.value);
  }
  for (const double integral : state.joint_integrals) hash.Add(integral);
  for (const std::uint32_t goals : state.goals) hash.Add(std::uint64_t{goals});
  if (state.devices != nullptr) AddToHash(*state.devices, hash);
  if (state.engine != nullptr) state.engine->AddToHash(hash);
}

}  // namespace gsv::world
