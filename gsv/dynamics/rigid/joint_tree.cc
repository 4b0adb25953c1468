// Parts that joints hold together, in joint coordinates (Featherstone's method, as btMultiBody).
#include <algorithm>
#include <cmath>
#include <optional>

#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "gsv/dynamics/motion/ball_angles.h"
#include "gsv/dynamics/motion/drive_servo.h"
#include "gsv/dynamics/motion/joint_control.h"
#include "gsv/dynamics/rigid/joint_row.h"
#include "gsv/dynamics/rigid/loop_rows.h"
#include "gsv/dynamics/rigid/moving_body.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using Kind = world::JointCommand::Kind;

constexpr double kNoLimit = 1e6;  // N, N m, m/s, rad/s: where the model sets none
// 1/s: a joint that is to be at a position turns there at this times the distance.
constexpr double kServoGain = 20;

bool Holds(const std::vector<int>& joints, int joint) {
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

// Keeps a joint to its limit of velocity, whatever drives it there. One that is far from it is left
// alone.
void Limit(JointRow& row, const model::Joint& joint, double rate, double force, double seconds) {
  const double limit = joint.velocity_limit, most = kNoLimit * seconds;
  if (std::abs(rate) < limit / 2 && force == 0) {
    row.Set(0, 0, 0);
  } else if (std::abs(rate) < limit / 2 ? force > 0 : rate > 0) {
    row.Set(limit, -most, 0);
  } else {
    row.Set(-limit, 0, most);
  }
}

class JointTree final : public MovingBody {
 public:
  JointTree(const RigidBody& plan, const model::WorldDescription& world_description,
            const world::State& state, std::span<Owner* const> owners,
            btMultiBodyDynamicsWorld& world);

  void BeforeSubstep(double seconds) override;
  void AfterSubstep(double) override {}
  double Speed() const override;
  double Thickness() const override;
  void Bounds(btVector3& low, btVector3& high) const override;
  void Store(double seconds, world::State& state) const override;

 private:
  struct Motor {
    int link;                           // index of a link in tree_
    int joint;                          // index of a joint in the model
    std::unique_ptr<JointRow> row;      // moves it, or rubs
    std::unique_ptr<JointRow> damper;   // null without damping
    std::unique_ptr<JointRow> limiter;  // null without a limit of velocity
    std::unique_ptr<JointRow> control;  // null without the gains of a controller
  };
  struct Wheel {
    int link;
    Owner* owner;
  };
  struct Ball {
    int link;
    BallAngles angles;
  };
  // Bullet knows no screws: a revolute link whose arm grows as it turns.
  struct Screw {
    int link;
    double pitch;  // m/rad
    btVector3 arm;
  };

  const std::vector<Part>& parts() const { return plan_.articulation.parts; }
  const Part& PartOf(int link) const { return parts()[static_cast<std::size_t>(link) + 1]; }
  const model::Joint& JointOf(const Part& part) const { return plan_.model->joints[part.joint]; }
  void SetUpLink(int link);
  void Place(const world::State& state);
  void PlaceBall(const Ball& ball, const world::State& state);
  void StoreBall(const Ball& ball, bool rests, world::State& state) const;
  void Slide();
  void LiftWhatIsWeightless();
  void Immerse(double seconds);
  bool IsBall(int link) const { return JointOf(PartOf(link)).kind == model::JointKind::kBall; }
  double Rate(int link) const;
  void AddCollider(int link, Owner& owner, btMultiBodyDynamicsWorld& world);
  void AddLimitsAndMotors(btMultiBodyDynamicsWorld& world);
  void Drive(double seconds);
  world::JointCommand CommandOf(int joint) const;
  void TurnMotors(double seconds);
  void Move(const Motor& motor, double rate, double seconds);
  void ForceTo(const Motor& motor, double rate, double seconds);
  void Follow(const Motor& motor, const model::Mimic& mimic, double seconds);
  void MoveKinematic(const Motor& motor, const world::JointCommand& command, double seconds);
  void Push(const Motor& motor, double force, double seconds);
  double Control(const Motor& motor, const world::JointCommand& command, double seconds);
  void CoupleFollowers();
  void CloseLoops(btMultiBodyDynamicsWorld& world);
  LoopRows::End EndOf(int link, const model::Joint& joint) const;
  std::unique_ptr<JointRow> AddJointRow(int link, btMultiBodyDynamicsWorld& world);
  Pose WorldFromModel() const;
  double RestingSpeed() const;

  const RigidBody& plan_;
  const model::WorldDescription& world_description_;
  btMultiBody tree_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> limits_;
  std::vector<std::unique_ptr<LoopRows>> loops_;
  std::vector<Motor> motors_;
  std::vector<Wheel> wheels_;
  std::vector<Ball> balls_;
  std::vector<Screw> screws_;
  std::optional<DriveServo> servo_;
  std::vector<world::JointCommand> commands_;  // commands of the model's joints; may be empty
  std::vector<double> integrals_;              // of the model's joints; may be empty
  // positions and rates that the drive wants of its joints
  std::vector<double> wanted_positions_, wanted_rates_;
  const btVector3 gravity_;
  double grip_;
  double resting_speed_before_;
};

JointTree::JointTree(const RigidBody& plan, const model::WorldDescription& world_description,
                     const world::State& state, std::span<Owner* const> owners,
                     btMultiBodyDynamicsWorld& world)
    : plan_(plan),
      world_description_(world_description),
      tree_(static_cast<int>(plan.articulation.parts.size()) - 1, plan.articulation.parts[0].mass,
            ToBullet(plan.articulation.parts[0].inertia), plan.articulation.is_fixed, false),
      wanted_positions_(plan.model->joints.size()),
      wanted_rates_(plan.model->joints.size()),
      gravity_(world.getGravity()),
      grip_(world.getGravity().length()) {
  for (int link = 0; link < tree_.getNumLinks(); ++link) SetUpLink(link);
  tree_.finalizeMultiDof();
  tree_.setLinearDamping(0);
  tree_.setAngularDamping(0);
  tree_.setUseGyroTerm(true);
  tree_.setHasSelfCollision(false);
  tree_.setMaxCoordinateVelocity(kNoLimit);
  tree_.setMaxAppliedImpulse(kNoLimit);
  Place(state);
  world.addMultiBody(&tree_);
  for (int link = -1; link < tree_.getNumLinks(); ++link) {
    Owner& owner = *owners[static_cast<std::size_t>(link + 1)];
    AddCollider(link, owner, world);
    if (owner.solid->wheel && !IsBall(link)) wheels_.push_back({link, &owner});
  }
  if (plan.kinematics) {
    servo_.emplace(*plan.kinematics, state.bodies[plan.body], state.time);
  }
  if (!state.joint_commands.empty()) {
    const auto first = state.joint_commands.begin() + plan.first_joint;
    commands_.assign(first, first + static_cast<std::ptrdiff_t>(plan.model->joints.size()));
  }
  if (!state.joint_integrals.empty()) {
    const auto first = state.joint_integrals.begin() + plan.first_joint;
    integrals_.assign(first, first + static_cast<std::ptrdiff_t>(plan.model->joints.size()));
  }
  AddLimitsAndMotors(world);
  CoupleFollowers();
  CloseLoops(world);
  resting_speed_before_ = RestingSpeed();
}

void JointTree::SetUpLink(int link) {
  const Part& part = PartOf(link);
  const Part& parent = parts()[static_cast<std::size_t>(part.parent)];
  const model::Joint& joint = JointOf(part);
  const Pose parent_from_part = Inverse(parent.model_from_part) * part.model_from_part;
  const Vector3& pivot = joint.model_from_joint.position;
  const Vector3 pivot_in_parent = Inverse(parent.model_from_part) * pivot;
  const Vector3 pivot_in_part = Inverse(part.model_from_part) * pivot;
  const Vector3 axis =
      Inverse(part.model_from_part.orientation) * (joint.model_from_joint.orientation * joint.axis);
  const btQuaternion part_from_parent = ToBullet(Inverse(parent_from_part.orientation));
  if (joint.kind == model::JointKind::kPrismatic) {
    tree_.setupPrismatic(link, part.mass, ToBullet(part.inertia), part.parent - 1, part_from_parent,
                         ToBullet(axis), ToBullet(pivot_in_parent), ToBullet(-pivot_in_part), true);
  } else if (joint.kind == model::JointKind::kBall) {
    tree_.setupSpherical(link, part.mass, ToBullet(part.inertia), part.parent - 1, part_from_parent,
                         ToBullet(pivot_in_parent), ToBullet(-pivot_in_part), true);
    balls_.push_back({link, BallAngles(*plan_.model, part)});
  } else {
    tree_.setupRevolute(link, part.mass, ToBullet(part.inertia), part.parent - 1, part_from_parent,
                        ToBullet(axis), ToBullet(pivot_in_parent), ToBullet(-pivot_in_part), true);
  }
  if (joint.kind == model::JointKind::kScrew) {
    btMultibodyLink& screw = tree_.getLink(link);
    screw.setAxisBottom(0, screw.getAxisBottom(0) + joint.thread_pitch * ToBullet(axis));
    screws_.push_back({link, joint.thread_pitch, screw.m_dVector});
  }
}

void JointTree::Slide() {
  for (const Screw& screw : screws_) {
    btMultibodyLink& link = tree_.getLink(screw.link);
    link.m_dVector = screw.arm + screw.pitch * tree_.getJointPos(screw.link) * link.getAxisTop(0);
    link.updateCacheMultiDof();
  }
}

void JointTree::PlaceBall(const Ball& ball, const world::State& state) {
  std::array<double, 3> angles, rates;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(plan_.first_joint + ball.angles.joints()[i]);
    angles[i] = state.joint_positions[joint];
    rates[i] = state.joint_velocities[joint];
  }
  const geometry::Quaternion turn = ball.angles.Turn(angles);
  const Vector3 omega = ball.angles.AngularVelocity(rates);
  const double position[] = {turn.x, turn.y, turn.z, turn.w};
  const double velocity[] = {omega.x, omega.y, omega.z};
  tree_.setJointPosMultiDof(ball.link, position);
  tree_.setJointVelMultiDof(ball.link, velocity);
}

void JointTree::StoreBall(const Ball& ball, bool rests, world::State& state) const {
  const btScalar* q = tree_.getJointPosMultiDof(ball.link);
  const btScalar* w = tree_.getJointVelMultiDof(ball.link);
  const std::array<double, 3> angles =
      ball.angles.AnglesOf(geometry::Normalized({q[3], q[0], q[1], q[2]}));
  const std::array<double, 3> rates = ball.angles.RatesOf({w[0], w[1], w[2]});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(plan_.first_joint + ball.angles.joints()[i]);
    if (!rests) state.joint_positions[joint] = angles[i];
    state.joint_velocities[joint] = rests ? 0 : rates[i];
  }
}

void JointTree::Place(const world::State& state) {
  const world::BodyState& body = state.bodies[plan_.body];
  const Pose world_from_base = body.world_from_model * parts()[0].model_from_part;
  const Vector3 arm = world_from_base.position - body.world_from_model.position;
  tree_.setBaseWorldTransform(ToBullet(world_from_base));
  if (!plan_.articulation.is_fixed) {
    tree_.setBaseVel(ToBullet(body.linear_velocity + Cross(body.angular_velocity, arm)));
    tree_.setBaseOmega(ToBullet(body.angular_velocity));
  }
  for (int link = 0; link < tree_.getNumLinks(); ++link) {
    if (IsBall(link)) continue;
    const int joint = plan_.first_joint + PartOf(link).joint;
    tree_.setJointPos(link, state.joint_positions[joint]);
    tree_.setJointVel(link, state.joint_velocities[joint]);
  }
  for (const Ball& ball : balls_) PlaceBall(ball, state);
  Slide();
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  tree_.forwardKinematics(rotations, origins);
}

void JointTree::AddCollider(int link, Owner& owner, btMultiBodyDynamicsWorld& world) {
  auto collider = std::make_unique<btMultiBodyLinkCollider>(&tree_, link);
  collider->setCollisionShape(owner.solid->shape);
  collider->setWorldTransform(link < 0 ? tree_.getBaseWorldTransform()
                                       : tree_.getLink(link).m_cachedWorldTransform);
  collider->setUserPointer(&owner);
  collider->setCollisionFlags(collider->getCollisionFlags() |
                              btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  if (owner.solid->bounces()) collider->setContactProcessingThreshold(0);
  if (link < 0) {
    tree_.setBaseCollider(collider.get());
  } else {
    tree_.getLink(link).m_collider = collider.get();
  }
  world.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter,
                           btBroadphaseProxy::AllFilter);
  colliders_.push_back(std::move(collider));
}

void JointTree::AddLimitsAndMotors(btMultiBodyDynamicsWorld& world) {
  for (int link = 0; link < tree_.getNumLinks(); ++link) {
    if (IsBall(link)) continue;
    const Part& part = PartOf(link);
    const model::Joint& joint = JointOf(part);
    const model::Range& limits = joint.position_limits;
    if (joint.kind != model::JointKind::kContinuous &&
        (std::isfinite(limits.min) || std::isfinite(limits.max))) {
      limits_.push_back(std::make_unique<btMultiBodyJointLimitConstraint>(
          &tree_, link, std::max(limits.min, -kNoLimit), std::min(limits.max, kNoLimit)));
      world.addMultiBodyConstraint(limits_.back().get());
    }
    Motor& motor =
        motors_.emplace_back(Motor{link, part.joint, AddJointRow(link, world), {}, {}, {}});
    if (joint.damping > 0) motor.damper = AddJointRow(link, world);
    if (joint.velocity_limit < kNoLimit) motor.limiter = AddJointRow(link, world);
    if (joint.position_gains || joint.velocity_gains) motor.control = AddJointRow(link, world);
  }
}

void JointTree::CoupleFollowers() {
  for (const Motor& motor : motors_) {
    const auto& mimic = plan_.model->joints[static_cast<std::size_t>(motor.joint)].mimic;
    if (!mimic) continue;
    for (const Motor& leader : motors_) {
      if (leader.joint == mimic->leader) motor.row->Couple(leader.link, mimic->multiplier);
    }
  }
}

// An end at the world (-1) is at the base, which then does not move.
LoopRows::End JointTree::EndOf(int link, const model::Joint& joint) const {
  const std::vector<int>& part_of_link = plan_.articulation.part_of_link;
  const int part = link < 0 ? 0 : part_of_link[static_cast<std::size_t>(link)];
  const Pose& model_from_part = parts()[static_cast<std::size_t>(part)].model_from_part;
  const btTransform part_from_joint = ToBullet(Inverse(model_from_part) * joint.model_from_joint);
  const btQuaternion axis_from_z = shortestArcQuat({0, 0, 1}, ToBullet(joint.axis));
  return {part - 1, part_from_joint * btTransform(axis_from_z)};
}

void JointTree::CloseLoops(btMultiBodyDynamicsWorld& world) {
  for (const model::Joint& joint : plan_.model->loop_joints) {
    const LoopRows::End parent = EndOf(joint.parent, joint), child = EndOf(joint.child, joint);
    if (parent.link == child.link) continue;
    world.addMultiBodyConstraint(
        loops_.emplace_back(std::make_unique<LoopRows>(tree_, parent, child, joint.kind)).get());
  }
}

std::unique_ptr<JointRow> JointTree::AddJointRow(int link, btMultiBodyDynamicsWorld& world) {
  auto row = std::make_unique<JointRow>(tree_, link);
  world.addMultiBodyConstraint(row.get());
  return row;
}

Pose JointTree::WorldFromModel() const {
  const Pose world_from_model =
      FromBullet(tree_.getBaseWorldTransform()) * Inverse(parts()[0].model_from_part);
  return {world_from_model.position, Normalized(world_from_model.orientation)};
}

void JointTree::Drive(double seconds) {
  const world::DriveCommand motion = servo_->Advance(seconds);
  if (!RollsOnWheels(*plan_.model)) {
    const Pose world_from_base = FromBullet(tree_.getBaseWorldTransform());
    Vector3 velocity = FromBullet(tree_.getBaseVel());
    Vector3 angular_velocity = FromBullet(tree_.getBaseOmega());
    HoldBase(*servo_, WorldFromModel(), world_from_base.position, grip_, seconds, velocity,
             angular_velocity);
    tree_.setBaseVel(ToBullet(velocity));
    tree_.setBaseOmega(ToBullet(angular_velocity));
  }
  for (const Motor& motor : motors_) wanted_positions_[motor.joint] = tree_.getJointPos(motor.link);
  std::fill(wanted_rates_.begin(), wanted_rates_.end(), 0.0);
  servo_->kinematics().TurnJoints({}, motion, seconds, wanted_positions_, wanted_rates_);
}

// Returns the present command of a joint: that of the drive if the joint belongs to it, else the
// joint's own.
world::JointCommand JointTree::CommandOf(int joint) const {
  if (servo_) {
    const model::Drive& drive = *plan_.model->drive;
    if (Holds(drive.steered, joint)) return {Kind::kPosition, wanted_positions_[joint]};
    if (Holds(drive.left_wheels, joint) || Holds(drive.right_wheels, joint)) {
      return {Kind::kVelocity, wanted_rates_[joint]};
    }
  }
  return commands_.empty() ? world::JointCommand{} : commands_[joint];
}

// A motor that takes the joint to a rate within its limit of effort.
void JointTree::Move(const Motor& motor, double rate, double seconds) {
  const model::Joint& joint = plan_.model->joints[motor.joint];
  const double fastest = std::min(joint.velocity_limit, kNoLimit);
  const double impulse = std::min(joint.effort_limit, kNoLimit) * seconds;
  motor.row->Set(std::clamp(rate, -fastest, fastest), -impulse, impulse);
}

// Moves the joint regardless of forces. Without a command, or with a command of effort, the joint
// does not move.
void JointTree::MoveKinematic(const Motor& motor, const world::JointCommand& command,
                              double seconds) {
  double rate = 0;
  if (command.kind == Kind::kVelocity) rate = command.value;
  if (command.kind == Kind::kPosition) {
    rate = kServoGain * (command.value - tree_.getJointPos(motor.link));
  }
  ForceTo(motor, rate, seconds);
}

// As gears do: the joint moves at its leader's rate times the multiplier, and towards where it
// should be. The leader feels the reaction.
void JointTree::Follow(const Motor& motor, const model::Mimic& mimic, double seconds) {
  const auto leader = std::find_if(motors_.begin(), motors_.end(),
                                   [&](const Motor& other) { return other.joint == mimic.leader; });
  // A leader that does not move is at 0.
  const double position = leader == motors_.end() ? 0 : tree_.getJointPos(leader->link);
  const double wanted = mimic.multiplier * (position - mimic.reference) + mimic.offset;
  ForceTo(motor, kServoGain * (wanted - tree_.getJointPos(motor.link)), seconds);
}

void JointTree::ForceTo(const Motor& motor, double rate, double seconds) {
  const double fastest =
      std::min(plan_.model->joints[static_cast<std::size_t>(motor.joint)].velocity_limit, kNoLimit);
  motor.row->Set(std::clamp(rate, -fastest, fastest), -kNoLimit * seconds, kNoLimit * seconds);
}

// A force, and Coulomb's friction: a motor that holds still with so much force.
void JointTree::Push(const Motor& motor, double force, double seconds) {
  const model::Joint& joint = plan_.model->joints[motor.joint];
  const double impulse = joint.friction * seconds;
  motor.row->Set(0, -impulse, impulse);
  if (force == 0) return;
  const double effort = std::min(joint.effort_limit, kNoLimit);
  tree_.addJointTorque(motor.link, std::clamp(force, -effort, effort));
}

// By the joint's controller. Returns the sign of its effort.
double JointTree::Control(const Motor& motor, const world::JointCommand& command, double seconds) {
  const model::Joint& joint = plan_.model->joints[static_cast<std::size_t>(motor.joint)];
  const double integral =
      integrals_.empty() ? 0 : integrals_[static_cast<std::size_t>(motor.joint)];
  const double rate = tree_.getJointVel(motor.link);
  const JointDemand demand =
      DemandOf(joint, command, tree_.getJointPos(motor.link), rate, integral, seconds);
  motor.control->Demand(demand.rate, demand.softness, std::max(demand.lower, -kNoLimit * seconds),
                        std::min(demand.upper, kNoLimit * seconds));
  return demand.rate - rate;
}

void JointTree::TurnMotors(double seconds) {
  for (const Motor& motor : motors_) {
    const model::Joint& joint = plan_.model->joints[motor.joint];
    const world::JointCommand command = CommandOf(motor.joint);
    if (joint.mimic) {
      Follow(motor, *joint.mimic, seconds);
      continue;
    }
    if (PartOf(motor.link).is_kinematic) {
      MoveKinematic(motor, command, seconds);
      continue;
    }
    double force = command.kind == Kind::kEffort ? command.value : 0;
    if (motor.control) motor.control->Set(0, 0, 0);
    if (GainsFor(joint, command.kind) != nullptr) {
      force = Control(motor, command, seconds);
      Push(motor, 0, seconds);
    } else if (command.kind == Kind::kVelocity) {
      Move(motor, command.value, seconds);
    } else if (command.kind == Kind::kPosition) {
      Move(motor, kServoGain * (command.value - tree_.getJointPos(motor.link)), seconds);
    } else {
      Push(motor, force, seconds);
    }
    // The damper's force is -damping times the joint's velocity at the end of the substep.
    if (motor.damper) motor.damper->Soften(0, 1 / (joint.damping * seconds));
    if (motor.limiter) Limit(*motor.limiter, joint, tree_.getJointVel(motor.link), force, seconds);
  }
}

void JointTree::BeforeSubstep(double seconds) {
  Slide();
  if (servo_) Drive(seconds);
  TurnMotors(seconds);
  for (const Wheel& wheel : wheels_) wheel.owner->rate = Rate(wheel.link);
  LiftWhatIsWeightless();
  if (!plan_.media.empty()) Immerse(seconds);
}

// Applies wind, fluid forces and the decay of velocity to each part.
void JointTree::Immerse(double seconds) {
  const auto count = static_cast<std::size_t>(tree_.getNumLinks()) + 1;
  // velocities of each part, in its own frame
  std::vector<btVector3> turning(count), moving(count);
  tree_.compTreeLinkVelocities(turning.data(), moving.data());
  for (std::size_t i = 0; i < count; ++i) {
    const int link = static_cast<int>(i) - 1;
    const btTransform place =
        link < 0 ? tree_.getBaseWorldTransform() : tree_.getLink(link).m_cachedWorldTransform;
    const PartMotion motion{FromBullet(place), FromBullet(place.getBasis() * moving[i]),
                            FromBullet(place.getBasis() * turning[i])};
    const Wrench wrench = WrenchOf(plan_.media[i], parts()[i], motion, world_description_, seconds);
    if (link < 0) {
      tree_.addBaseForce(ToBullet(wrench.force));
      tree_.addBaseTorque(ToBullet(wrench.torque));
    } else {
      tree_.addLinkForce(link, ToBullet(wrench.force));
      tree_.addLinkTorque(link, ToBullet(wrench.torque));
    }
  }
}

// Bullet applies gravity to all parts, so this cancels it for weightless ones.
void JointTree::LiftWhatIsWeightless() {
  for (std::size_t i = 0; i < parts().size(); ++i) {
    const Part& part = parts()[i];
    if (part.heaviness == 1) continue;
    const btVector3 lift = -(1 - part.heaviness) * part.mass * gravity_;
    if (i == 0) {
      tree_.addBaseForce(lift);
    } else {
      tree_.addLinkForce(static_cast<int>(i) - 1, lift);
    }
  }
}

// rad/s or m/s
double JointTree::Rate(int link) const {
  if (!IsBall(link)) return std::abs(tree_.getJointVel(link));
  const btScalar* rate = tree_.getJointVelMultiDof(link);
  return btVector3(rate[0], rate[1], rate[2]).length();
}

double JointTree::Speed() const {
  double speed = tree_.getBaseVel().length();
  double turning = tree_.getBaseOmega().length();
  speed += turning * plan_.solids[0].radius;
  for (int link = 0; link < tree_.getNumLinks(); ++link) {
    const double rate = Rate(link);
    const model::Joint& joint = JointOf(PartOf(link));
    const double radius = plan_.solids[static_cast<std::size_t>(link) + 1].radius;
    speed += joint.kind == model::JointKind::kPrismatic
                 ? rate
                 : rate * (radius + std::abs(joint.thread_pitch));
  }
  return speed;
}

double JointTree::Thickness() const {
  double least = plan_.solids[0].thickness;
  for (const Solid& solid : plan_.solids) least = std::min(least, solid.thickness);
  return least;
}

void JointTree::Bounds(btVector3& low, btVector3& high) const {
  colliders_[0]->getCollisionShape()->getAabb(colliders_[0]->getWorldTransform(), low, high);
  for (const auto& collider : colliders_) {
    btVector3 a, b;
    collider->getCollisionShape()->getAabb(collider->getWorldTransform(), a, b);
    low.setMin(a);
    high.setMax(b);
  }
}

double JointTree::RestingSpeed() const {
  double fastest = std::max(tree_.getBaseVel().length(), tree_.getBaseOmega().length());
  for (int link = 0; link < tree_.getNumLinks(); ++link) {
    fastest = std::max<double>(fastest, Rate(link));
  }
  return fastest;
}

void JointTree::Store(double seconds, world::State& state) const {
  world::BodyState& body = state.bodies[plan_.body];
  if (servo_) body.drive.actual = servo_->motion();
  const double rest = kResting * seconds;
  const bool rests = resting_speed_before_ < rest && RestingSpeed() < rest;
  for (const Ball& ball : balls_) StoreBall(ball, rests, state);
  for (int link = 0; link < tree_.getNumLinks(); ++link) {
    if (IsBall(link)) continue;
    const int joint = plan_.first_joint + PartOf(link).joint;
    // A limit stops a joint within a substep; so far it may have gone beyond.
    const model::Range& limits = JointOf(PartOf(link)).position_limits;
    if (!rests) {
      state.joint_positions[joint] = std::clamp(tree_.getJointPos(link), limits.min, limits.max);
    }
    state.joint_velocities[joint] = rests ? 0 : tree_.getJointVel(link);
  }
  if (rests) {
    body.linear_velocity = body.angular_velocity = {};
  } else if (!plan_.articulation.is_fixed) {
    StoreMotion(WorldFromModel(), FromBullet(tree_.getBaseWorldTransform()).position,
                FromBullet(tree_.getBaseVel()), FromBullet(tree_.getBaseOmega()), body);
  }
}

}  // namespace

std::unique_ptr<MovingBody> MakeJointTree(const RigidBody& plan,
                                          const model::WorldDescription& world_description,
                                          const world::State& state, std::span<Owner* const> owners,
                                          btMultiBodyDynamicsWorld& world) {
  return std::make_unique<JointTree>(plan, world_description, state, owners, world);
}

}  // namespace gsv::dynamics
