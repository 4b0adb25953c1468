#include <algorithm>
#include <limits>
#include <optional>

#include <LinearMath/btTransformUtil.h>

#include "gsv/dynamics/motion/drive_servo.h"
#include "gsv/dynamics/rigid/moving_body.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

class FreeBody final : public MovingBody {
 public:
  FreeBody(const RigidBody& plan, const model::WorldDescription& world_description,
           const world::State& state, Owner& owner, btMultiBodyDynamicsWorld& world)
      : plan_(plan),
        owner_(owner),
        grip_(is_kinematic() ? std::numeric_limits<double>::infinity()
                             : world.getGravity().length()),
        gravity_(world.getGravity() * (is_kinematic() ? 0 : part().heaviness)),
        world_(plan.media.empty() ? nullptr : &world_description),
        object_(Description()) {
    const world::BodyState& body = state.bodies[plan.body];
    was_resting_speed_ = std::max(Norm(body.linear_velocity), Norm(body.angular_velocity));
    const Pose world_from_part = body.world_from_model * part().model_from_part;
    const Vector3 arm = world_from_part.position - body.world_from_model.position;
    object_.setWorldTransform(ToBullet(world_from_part));
    object_.setInterpolationWorldTransform(object_.getWorldTransform());
    object_.setLinearVelocity(ToBullet(body.linear_velocity + Cross(body.angular_velocity, arm)));
    object_.setAngularVelocity(ToBullet(body.angular_velocity));
    object_.setActivationState(DISABLE_DEACTIVATION);
    object_.setUserPointer(&owner);
    object_.setCollisionFlags(object_.getCollisionFlags() |
                              btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    // A body that bounces must reach the other body at its full speed.
    if (plan.solids[0].bounces()) object_.setContactProcessingThreshold(0);
    if (plan.kinematics) servo_.emplace(*plan.kinematics, body, state.time);
    if (is_kinematic()) {
      AddKinematic(world);
      return;
    }
    world.addRigidBody(&object_, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    object_.setGravity(gravity_);
  }

  void BeforeSubstep(double seconds) override {
    if (servo_) Hold(seconds);
    if (is_kinematic()) {
      MoveOn(seconds);
    } else if (world_ != nullptr) {
      Immerse(seconds);
    }
  }

  // Bullet moves by the velocity at a substep's end; on a parabola the mean of both ends is right.
  void AfterSubstep(double seconds) override {
    if (owner_.touches || plan_.articulation.is_fixed || is_kinematic()) return;
    btTransform place = object_.getWorldTransform();
    place.setOrigin(place.getOrigin() - (gravity_ + pushed_) * (seconds * seconds / 2));
    object_.setWorldTransform(place);
    object_.setInterpolationWorldTransform(place);
  }

  double Speed() const override {
    return object_.getLinearVelocity().length() +
           object_.getAngularVelocity().length() * plan_.solids[0].radius;
  }
  double Thickness() const override { return plan_.solids[0].thickness; }
  void Bounds(btVector3& low, btVector3& high) const override { object_.getAabb(low, high); }
  btRigidBody* rigid() override { return &object_; }

  void Store(double seconds, world::State& state) const override {
    world::BodyState& body = state.bodies[plan_.body];
    if (servo_) body.drive.actual = servo_->motion();
    const Vector3 velocity = FromBullet(object_.getLinearVelocity());
    const Vector3 angular_velocity = FromBullet(object_.getAngularVelocity());
    const double rest = kResting * seconds;
    if (was_resting_speed_ < rest && Norm(velocity) < rest && Norm(angular_velocity) < rest) {
      body.linear_velocity = body.angular_velocity = {};
      return;
    }
    Pose world_from_part = FromBullet(object_.getWorldTransform());
    world_from_part.orientation = Normalized(world_from_part.orientation);
    const Pose world_from_model = world_from_part * Inverse(part().model_from_part);
    StoreMotion({world_from_model.position, Normalized(world_from_model.orientation)},
                world_from_part.position, velocity, angular_velocity, body);
  }

 private:
  const Part& part() const { return plan_.articulation.parts[0]; }
  bool is_kinematic() const { return part().is_kinematic && !plan_.articulation.is_fixed; }

  // Static bodies do not collide with it.
  void AddKinematic(btMultiBodyDynamicsWorld& world) {
    object_.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT |
                              btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    world.addRigidBody(&object_, btBroadphaseProxy::KinematicFilter,
                       btBroadphaseProxy::DefaultFilter);
  }

  void Hold(double seconds) {
    servo_->Advance(seconds);
    const Pose world_from_part = FromBullet(object_.getWorldTransform());
    Vector3 velocity = FromBullet(object_.getLinearVelocity());
    Vector3 angular_velocity = FromBullet(object_.getAngularVelocity());
    HoldBase(*servo_, world_from_part * Inverse(part().model_from_part), world_from_part.position,
             grip_, seconds, velocity, angular_velocity);
    object_.setLinearVelocity(ToBullet(velocity));
    object_.setAngularVelocity(ToBullet(angular_velocity));
  }

  // Bullet takes a kinematic body's velocity from where it was and where it is.
  void MoveOn(double seconds) {
    const btTransform before = object_.getWorldTransform();
    btTransform after;
    btTransformUtil::integrateTransform(before, object_.getLinearVelocity(),
                                        object_.getAngularVelocity(), seconds, after);
    object_.setInterpolationWorldTransform(before);
    object_.setWorldTransform(after);
  }

  void Immerse(double seconds) {
    const PartMotion motion{FromBullet(object_.getWorldTransform()),
                            FromBullet(object_.getLinearVelocity()),
                            FromBullet(object_.getAngularVelocity())};
    const Wrench wrench = WrenchOf(plan_.media[0], part(), motion, *world_, seconds);
    object_.applyCentralForce(ToBullet(wrench.force));
    object_.applyTorque(ToBullet(wrench.torque));
    pushed_ = ToBullet(wrench.force) / part().mass;
  }

  btRigidBody::btRigidBodyConstructionInfo Description() const {
    const bool is_fixed = plan_.articulation.is_fixed;
    const bool is_moved = !is_fixed && !is_kinematic();
    return {is_moved ? part().mass : 0, nullptr, plan_.solids[0].shape,
            is_moved ? ToBullet(part().inertia) : btVector3(0, 0, 0)};
  }

  const RigidBody& plan_;
  const Owner& owner_;
  const double grip_;
  const btVector3 gravity_;
  const model::WorldDescription* const world_;  // null: no medium pushes it
  btVector3 pushed_{0, 0, 0};                   // m/s²: by what surrounds it, in this substep
  btRigidBody object_;
  std::optional<DriveServo> servo_;
  double was_resting_speed_;
};

}  // namespace

std::unique_ptr<MovingBody> MakeFreeBody(const RigidBody& plan,
                                         const model::WorldDescription& world_description,
                                         const world::State& state, Owner& owner,
                                         btMultiBodyDynamicsWorld& world) {
  return std::make_unique<FreeBody>(plan, world_description, state, owner, world);
}

void StoreMotion(const Pose& world_from_model, const Vector3& point, const Vector3& velocity,
                 const Vector3& angular_velocity, world::BodyState& body) {
  body.distance += Norm(world_from_model.position - body.world_from_model.position);
  body.world_from_model = world_from_model;
  body.linear_velocity = velocity + Cross(angular_velocity, world_from_model.position - point);
  body.angular_velocity = angular_velocity;
}

}  // namespace gsv::dynamics
