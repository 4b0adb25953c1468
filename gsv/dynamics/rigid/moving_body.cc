#include "gsv/dynamics/rigid/moving_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/dynamics/motion/joint_control.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using CommandKind = world::JointCommand::Kind;

constexpr double kNoLimit = 1e6;  // used if the model sets no limit: N, N m, m/s, rad/s
// 1/s: a joint moves towards its commanded position at this rate times the distance
constexpr double kServoGain = 20;
// The fraction of a violation of a joint's limit that a substep corrects.
constexpr double kLimitCorrection = 0.2;

bool Holds(const std::vector<int>& joints, int joint) {
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

}  // namespace

MovingBody::MovingBody(const RigidBody& plan, const model::WorldDescription& world)
    : plan_(plan),
      world_(world),
      tree_(plan),
      loops_(LoopJointsOf(plan)),
      wanted_positions_(plan.model->joints.size()),
      wanted_rates_(plan.model->joints.size()),
      is_kinematic_(plan.articulation.parts.size() == 1 &&
                    plan.articulation.parts[0].is_kinematic && !plan.articulation.is_fixed),
      rolls_(RollsOnWheels(*plan.model)),
      thickness_(plan.solids[0].thickness) {
  for (const Solid& solid : plan.solids) thickness_ = std::min(thickness_, solid.thickness);
  for (int i = 1; i < static_cast<int>(plan.articulation.parts.size()); ++i) {
    const int joint = part(i).joint;
    if (plan.model->joints[static_cast<std::size_t>(joint)].kind == model::JointKind::kBall)
      continue;
    motors_.push_back({i, joint, tree_.first_velocity(i)});
  }
}

void MovingBody::Load(const world::State& state) {
  tree_.Load(state);
  const world::BodyState& body = state.bodies[static_cast<std::size_t>(plan_.body)];
  if (is_kinematic_) {
    const Vector3 arm = body.world_from_model.orientation * part(0).model_from_part.position;
    velocity_ = body.linear_velocity + Cross(body.angular_velocity, arm);
    angular_velocity_ = body.angular_velocity;
  }
  servo_.reset();
  if (plan_.kinematics) servo_.emplace(*plan_.kinematics, body, state.time);
  commands_.clear();
  if (!state.joint_commands.empty()) {
    const auto first = state.joint_commands.begin() + plan_.first_joint;
    commands_.assign(first, first + static_cast<std::ptrdiff_t>(plan_.model->joints.size()));
  }
  integrals_.clear();
  if (!state.joint_integrals.empty()) {
    const auto first = state.joint_integrals.begin() + plan_.first_joint;
    integrals_.assign(first, first + static_cast<std::ptrdiff_t>(plan_.model->joints.size()));
  }
  separating_speed_ = 0;
  is_held_ = false;
  resting_speed_before_ = tree_.is_single()
                              ? std::max(Norm(body.linear_velocity), Norm(body.angular_velocity))
                              : RestingSpeed();
}

void MovingBody::Place() { tree_.Place(); }

Pose MovingBody::WorldFromModel() const {
  const Pose world_from_model = tree_.pose(0) * Inverse(part(0).model_from_part);
  return {world_from_model.position, Normalized(world_from_model.orientation)};
}

Vector3 MovingBody::VelocityOf(int part, const Vector3& point) const {
  if (is_kinematic_) return velocity_ + Cross(angular_velocity_, point - tree_.position(0));
  return tree_.VelocityOf(part, point);
}

void MovingBody::BeforeSubstep(double seconds) {
  if (servo_) Drive(seconds);
  rows_.Clear();
  if (tree_.size() == 0) return;
  tree_.WriteMass();
  tree_.ClearForces();
  AddForces(seconds);
  AddJointRows(seconds);
  tree_.Accelerate(seconds);
}

// Adds gravity, wind, fluids and the decay of velocities for each part.
void MovingBody::AddForces(double seconds) {
  const auto count = static_cast<int>(plan_.articulation.parts.size());
  for (int i = 0; i < count; ++i) {
    Vector3 force = part(i).mass * part(i).heaviness * world_.gravity, torque;
    if (!plan_.media.empty()) {
      const PartMotion motion{tree_.pose(i), tree_.VelocityOf(i, tree_.position(i)),
                              tree_.angular_velocity(i)};
      const Wrench wrench =
          WrenchOf(plan_.media[static_cast<std::size_t>(i)], part(i), motion, world_, seconds);
      force += wrench.force;
      torque = wrench.torque;
    }
    tree_.AddForce(i, force, torque);
    if (i == 0) outer_acceleration_ = (1 / part(0).mass) * force;
  }
}

void MovingBody::Drive(double seconds) {
  const world::DriveCommand motion = servo_->Advance(seconds);
  if (!rolls_) {
    Vector3 velocity = is_kinematic_ ? velocity_ : tree_.base_velocity();
    Vector3 angular_velocity = is_kinematic_ ? angular_velocity_ : tree_.base_angular_velocity();
    const double grip =
        is_kinematic_ ? std::numeric_limits<double>::infinity() : Norm(world_.gravity);
    HoldBase(*servo_, WorldFromModel(), tree_.position(0), grip, seconds, velocity,
             angular_velocity);
    if (is_kinematic_) {
      velocity_ = velocity;
      angular_velocity_ = angular_velocity;
    } else if (tree_.is_moved_base()) {
      tree_.SetBaseVelocity(velocity, angular_velocity);
    }
  }
  for (const Motor& motor : motors_) {
    wanted_positions_[static_cast<std::size_t>(motor.joint)] = tree_.joint_position(motor.part);
  }
  std::fill(wanted_rates_.begin(), wanted_rates_.end(), 0.0);
  servo_->kinematics().TurnJoints({}, motion, seconds, wanted_positions_, wanted_rates_);
}

// Returns the current command of a joint. The command of a joint of the drive comes from the drive.
world::JointCommand MovingBody::CommandOf(int joint) const {
  const auto index = static_cast<std::size_t>(joint);
  if (servo_) {
    const model::Drive& drive = *plan_.model->drive;
    if (Holds(drive.steered, joint)) return {CommandKind::kPosition, wanted_positions_[index]};
    if (Holds(drive.left_wheels, joint) || Holds(drive.right_wheels, joint)) {
      return {CommandKind::kVelocity, wanted_rates_[index]};
    }
  }
  return commands_.empty() ? world::JointCommand{} : commands_[index];
}

void MovingBody::AddJointRows(double seconds) {
  for (const Motor& motor : motors_) {
    AddPositionLimits(motor, seconds);
    AddMotor(motor, seconds);
  }
  for (const LoopJoint& loop : loops_) loop.AddRows(tree_, seconds, rows_);
}

// Adds a motor that drives the joint at a rate within its velocity limit, with at most this
// impulse.
void MovingBody::AddRow(const Motor& motor, double rate, double impulse) {
  if (!(impulse > 0)) return;
  is_held_ = true;
  const double fastest = std::min(JointOf(motor).velocity_limit, kNoLimit);
  JointRow& row = rows_.Add(motor.velocity);
  row.target = std::clamp(rate, -fastest, fastest);
  row.lower = -impulse;
  row.upper = impulse;
}

void MovingBody::AddMotor(const Motor& motor, double seconds) {
  const model::Joint& joint = JointOf(motor);
  if (joint.mimic) {
    Follow(motor, *joint.mimic, seconds);
    return;
  }
  const world::JointCommand command = CommandOf(motor.joint);
  double rate = 0;
  if (command.kind == CommandKind::kVelocity) rate = command.value;
  if (command.kind == CommandKind::kPosition) {
    rate = kServoGain * (command.value - tree_.joint_position(motor.part));
  }
  // No force moves a kinematic joint. Without a command, or with an effort command, it does not
  // move.
  if (part(motor.part).is_kinematic) {
    AddRow(motor, rate, kNoLimit * seconds);
    return;
  }
  double force = command.kind == CommandKind::kEffort ? command.value : 0;
  if (GainsFor(joint, command.kind) != nullptr) {
    force = AddControl(motor, command, seconds);
    AddPush(motor, 0, seconds);
  } else if (command.kind == CommandKind::kVelocity || command.kind == CommandKind::kPosition) {
    AddRow(motor, rate, std::min(joint.effort_limit, kNoLimit) * seconds);
    // Friction does not slow down a motor whose effort has no limit.
    if (joint.effort_limit < kNoLimit) AddPush(motor, 0, seconds);
  } else {
    AddPush(motor, force, seconds);
  }
  if (joint.damping > 0) {
    // The damper's force is -damping times the joint's velocity at the end of the substep.
    rows_.Add(motor.velocity).softness = 1 / (joint.damping * seconds);
  }
  if (joint.velocity_limit < kNoLimit) AddVelocityLimit(motor, force, seconds);
}

// Adds a force of the joint. Also adds Coulomb's friction, as a motor that holds the joint with at
// most the friction force.
void MovingBody::AddPush(const Motor& motor, double force, double seconds) {
  const model::Joint& joint = JointOf(motor);
  AddRow(motor, 0, joint.friction * seconds);
  const double effort = std::min(joint.effort_limit, kNoLimit);
  if (force != 0) tree_.AddEffort(motor.velocity, std::clamp(force, -effort, effort));
}

// Adds the row of the joint's controller. Returns a number with the sign of the controller's effort
// at the start of the substep.
double MovingBody::AddControl(const Motor& motor, const world::JointCommand& command,
                              double seconds) {
  const double integral =
      integrals_.empty() ? 0 : integrals_[static_cast<std::size_t>(motor.joint)];
  const double rate = tree_.joint_velocity(motor.part), most = kNoLimit * seconds;
  const JointDemand demand =
      DemandOf(JointOf(motor), command, tree_.joint_position(motor.part), rate, integral, seconds);
  is_held_ = true;
  JointRow& row = rows_.Add(motor.velocity);
  row.target = demand.rate;
  row.softness = demand.softness;
  row.lower = std::max(demand.lower, -most);
  row.upper = std::min(demand.upper, most);
  return demand.rate - rate;
}

// Limits the velocity of a joint, whatever force causes it.
void MovingBody::AddVelocityLimit(const Motor& motor, double force, double seconds) {
  const double limit = JointOf(motor).velocity_limit, most = kNoLimit * seconds;
  const double rate = tree_.joint_velocity(motor.part);
  if (std::abs(rate) < limit / 2 && force == 0) return;
  const bool is_upper = std::abs(rate) < limit / 2 ? force > 0 : rate > 0;
  JointRow& row = rows_.Add(motor.velocity);
  row.target = is_upper ? limit : -limit;
  row.lower = is_upper ? -most : 0;
  row.upper = is_upper ? 0 : most;
}

// Adds rows that stop the joint at its limits. They limit the joint's velocity, so that the joint
// reaches a limit at the end of the substep at the earliest.
void MovingBody::AddPositionLimits(const Motor& motor, double seconds) {
  const model::Joint& joint = JointOf(motor);
  if (joint.kind == model::JointKind::kContinuous) return;
  const double at = tree_.joint_position(motor.part), most = kNoLimit;
  const double near = 0.05 + 2 * std::abs(tree_.joint_velocity(motor.part)) * seconds;
  for (const double sign : {1.0, -1.0}) {
    const double limit = sign > 0 ? joint.position_limits.min : joint.position_limits.max;
    const double room = sign * (at - limit);
    if (!(room < near)) continue;
    is_held_ = is_held_ || room <= 0;
    JointRow& row = rows_.Add(motor.velocity);
    row.target = -sign * (room > 0 ? room : kLimitCorrection * room) / seconds;
    row.lower = sign > 0 ? 0 : -most;
    row.upper = sign > 0 ? most : 0;
  }
}

// Couples a joint to its leader like a gear. The joint moves at the leader's rate times the
// multiplier, and towards its correct position. The reaction acts on the leader.
void MovingBody::Follow(const Motor& motor, const model::Mimic& mimic, double seconds) {
  const auto leader = std::find_if(motors_.begin(), motors_.end(),
                                   [&](const Motor& other) { return other.joint == mimic.leader; });
  // A leader without a motor, such as a fixed joint, has position 0.
  const double position = leader == motors_.end() ? 0 : tree_.joint_position(leader->part);
  const double wanted = mimic.multiplier * (position - mimic.reference) + mimic.offset;
  AddRow(motor, kServoGain * (wanted - tree_.joint_position(motor.part)), kNoLimit * seconds);
  if (leader != motors_.end() && leader->velocity != motor.velocity) {
    rows_.AddValue(leader->velocity, -mimic.multiplier);
  }
}

void MovingBody::AfterSubstep(std::span<const double> velocities, bool is_touched, double seconds) {
  if (is_kinematic_) {
    is_held_ = true;
    tree_.Shift(seconds * velocity_, seconds * angular_velocity_);
    return;
  }
  is_held_ = is_held_ || is_touched || !plan_.media.empty();
  std::copy(velocities.begin(), velocities.end(), tree_.velocities().begin());
  tree_.Move(velocities, seconds);
  if (!tree_.is_single() || !tree_.is_moved_base() || is_touched) return;
  // Moves the body back by half of the effect of the acceleration. So it moves at the mean of its
  // velocities at the start and at the end, which is exact under a constant force.
  tree_.Shift((-seconds * seconds / 2) * outer_acceleration_, {});
}

void MovingBody::Separate(const Vector3& velocity, double seconds) {
  const double speed = Norm(velocity);
  if (!(speed > 0)) return;
  separating_speed_ = std::max(separating_speed_, speed);
  tree_.Shift(seconds * velocity, {});
}

// rad/s or m/s
double MovingBody::Rate(int index) const {
  const auto chain = tree_.Chain(index);
  const auto velocities = tree_.velocities();
  const auto rate = [&](std::size_t i) { return velocities[static_cast<std::size_t>(chain[i])]; };
  const auto& joint = plan_.model->joints[static_cast<std::size_t>(part(index).joint)];
  if (joint.kind == model::JointKind::kBall) return Norm(Vector3{rate(2), rate(1), rate(0)});
  return std::abs(rate(0));
}

double MovingBody::WheelRate(int index) const {
  if (index == 0) return 0;
  const auto& joint = plan_.model->joints[static_cast<std::size_t>(part(index).joint)];
  return joint.kind == model::JointKind::kBall ? 0 : Rate(index);
}

double MovingBody::Speed() const {
  const Vector3 velocity = is_kinematic_ ? velocity_ : tree_.base_velocity();
  const Vector3 turning = is_kinematic_ ? angular_velocity_ : tree_.base_angular_velocity();
  double speed = Norm(velocity) + Norm(turning) * plan_.solids[0].radius;
  for (std::size_t i = 1; i < plan_.solids.size(); ++i) {
    const double rate = Rate(static_cast<int>(i));
    const auto& joint =
        plan_.model->joints[static_cast<std::size_t>(part(static_cast<int>(i)).joint)];
    speed += joint.kind == model::JointKind::kPrismatic
                 ? rate
                 : rate * (plan_.solids[i].radius + std::abs(joint.thread_pitch));
  }
  return speed;
}

double MovingBody::RestingSpeed() const {
  double fastest = std::max(Norm(tree_.base_velocity()), Norm(tree_.base_angular_velocity()));
  for (std::size_t i = 1; i < plan_.solids.size(); ++i) {
    fastest = std::max(fastest, Rate(static_cast<int>(i)));
  }
  return fastest;
}

void MovingBody::StoreBall(int index, bool rests, world::State& state) const {
  const BallAngles ball(*plan_.model, part(index));
  const auto at = static_cast<std::size_t>(tree_.first_velocity(index));
  const auto v = tree_.velocities();
  const std::array<double, 3> angles = ball.AnglesOf(tree_.turn(index));
  const std::array<double, 3> rates = ball.RatesOf({v[at], v[at + 1], v[at + 2]});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(plan_.first_joint + ball.joints()[i]);
    if (!rests) state.joint_positions[joint] = angles[i];
    state.joint_velocities[joint] = rests ? 0 : rates[i];
  }
}

void MovingBody::StoreJoints(bool rests, world::State& state) const {
  for (int i = 1; i < static_cast<int>(plan_.articulation.parts.size()); ++i) {
    const auto& joint = plan_.model->joints[static_cast<std::size_t>(part(i).joint)];
    if (joint.kind == model::JointKind::kBall) {
      StoreBall(i, rests, state);
      continue;
    }
    const auto index = static_cast<std::size_t>(plan_.first_joint + part(i).joint);
    // A limit stops a joint only after a substep, so the joint may have exceeded it slightly.
    const model::Range& limits = joint.position_limits;
    if (!rests) {
      state.joint_positions[index] = std::clamp(tree_.joint_position(i), limits.min, limits.max);
    }
    state.joint_velocities[index] = rests ? 0 : tree_.joint_velocity(i);
  }
}

bool MovingBody::Store(double seconds, world::State& state) const {
  world::BodyState& body = state.bodies[static_cast<std::size_t>(plan_.body)];
  if (servo_) body.drive.actual = servo_->motion();
  const Vector3 velocity = is_kinematic_ ? velocity_ : tree_.base_velocity();
  const Vector3 turning = is_kinematic_ ? angular_velocity_ : tree_.base_angular_velocity();
  const double rest = kResting * seconds;
  const double speed = tree_.is_single() ? std::max(Norm(velocity), Norm(turning)) : RestingSpeed();
  const bool rests =
      is_held_ && resting_speed_before_ < rest && speed < rest && separating_speed_ < rest;
  StoreJoints(rests, state);
  if (rests) {
    body.linear_velocity = body.angular_velocity = {};
    return true;
  }
  if (plan_.articulation.is_fixed) return false;
  const Pose world_from_model = WorldFromModel();
  body.distance += Norm(world_from_model.position - body.world_from_model.position);
  body.world_from_model = world_from_model;
  body.linear_velocity = velocity + Cross(turning, world_from_model.position - tree_.position(0));
  body.angular_velocity = turning;
  return false;
}

}  // namespace gsv::dynamics
