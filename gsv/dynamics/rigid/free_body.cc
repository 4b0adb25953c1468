#include <algorithm>
#include <optional>

#include "gsv/dynamics/motion/drive_servo.h"
#include "gsv/dynamics/rigid/moving_body.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

class FreeBody final : public MovingBody {
 public:
  FreeBody(const RigidBody& plan, const world::State& state, Owner& owner,
           btMultiBodyDynamicsWorld& world)
      : plan_(plan),
        owner_(owner),
        grip_(world.getGravity().length()),
        gravity_(world.getGravity() * part().heaviness),
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
    // What bounces must reach what it bounces off at its full speed.
    if (plan.solids[0].bounces()) object_.setContactProcessingThreshold(0);
    if (plan.kinematics) servo_.emplace(*plan.kinematics, body, state.time);
    world.addRigidBody(&object_, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    object_.setGravity(gravity_);
  }

  void BeforeSubstep(double seconds) override {
    if (!servo_) return;
    servo_->Advance(seconds);
    const Pose world_from_part = FromBullet(object_.getWorldTransform());
    Vector3 velocity = FromBullet(object_.getLinearVelocity());
    Vector3 angular_velocity = FromBullet(object_.getAngularVelocity());
    HoldBase(*servo_, world_from_part * Inverse(part().model_from_part), world_from_part.position,
             grip_, seconds, velocity, angular_velocity);
    object_.setLinearVelocity(ToBullet(velocity));
    object_.setAngularVelocity(ToBullet(angular_velocity));
  }

  // Bullet moves by the velocity at a substep's end; on a parabola the mean of both ends is right.
  void AfterSubstep(double seconds) override {
    if (owner_.touches || plan_.articulation.is_fixed) return;
    btTransform place = object_.getWorldTransform();
    place.setOrigin(place.getOrigin() - gravity_ * (seconds * seconds / 2));
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

  btRigidBody::btRigidBodyConstructionInfo Description() const {
    const bool is_fixed = plan_.articulation.is_fixed;
    return {is_fixed ? 0 : part().mass, nullptr, plan_.solids[0].shape,
            is_fixed ? btVector3(0, 0, 0) : ToBullet(part().inertia)};
  }

  const RigidBody& plan_;
  const Owner& owner_;
  const double grip_;
  const btVector3 gravity_;
  btRigidBody object_;
  std::optional<DriveServo> servo_;
  double was_resting_speed_;
};

}  // namespace

std::unique_ptr<MovingBody> MakeFreeBody(const RigidBody& plan, const world::State& state,
                                         Owner& owner, btMultiBodyDynamicsWorld& world) {
  return std::make_unique<FreeBody>(plan, state, owner, world);
}

void StoreMotion(const Pose& world_from_model, const Vector3& point, const Vector3& velocity,
                 const Vector3& angular_velocity, world::BodyState& body) {
  body.distance += Norm(world_from_model.position - body.world_from_model.position);
  body.world_from_model = world_from_model;
  body.linear_velocity = velocity + Cross(angular_velocity, world_from_model.position - point);
  body.angular_velocity = angular_velocity;
}

}  // namespace gsv::dynamics
