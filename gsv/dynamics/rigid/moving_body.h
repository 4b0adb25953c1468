// One body of a rigid scene in Bullet's world: a rigid body, or a tree of links in joint
// coordinates, which no joint can drift apart in. Private to this folder: it includes Bullet.
#pragma once

#include <memory>
#include <span>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "gsv/dynamics/rigid/rigid_contacts.h"

namespace gsv::dynamics {

class MovingBody {
 public:
  virtual ~MovingBody() = default;

  // Follows commands for the next substep.
  virtual void BeforeSubstep(double seconds) = 0;
  // Applies the effects that the explicit integration does not include.
  virtual void AfterSubstep(double seconds) = 0;
  // An upper bound of the speed of all points, in m/s.
  virtual double Speed() const = 0;
  // m: half of the least thickness of any part.
  virtual double Thickness() const = 0;
  virtual void Bounds(btVector3& low, btVector3& high) const = 0;
  // Returns null for a tree of links.
  virtual btRigidBody* rigid() { return nullptr; }

  // Writes pose and velocity to `state`, except for bodies that were at rest and still are.
  virtual void Store(double seconds, world::State& state) const = 0;
};

// `world_description` is the world that the body is in.
std::unique_ptr<MovingBody> MakeFreeBody(const RigidBody& plan,
                                         const model::WorldDescription& world_description,
                                         const world::State& state, Owner& owner,
                                         btMultiBodyDynamicsWorld& world);
// `owners` are those of the plan's solids. Joints keep to their limits, are damped and rub; those
// of a drive's wheels turn as the drive wants (RollsOnWheels()), its steering goes where it wants.
std::unique_ptr<MovingBody> MakeJointTree(const RigidBody& plan,
                                          const model::WorldDescription& world_description,
                                          const world::State& state, std::span<Owner* const> owners,
                                          btMultiBodyDynamicsWorld& world);

// m/s² and rad/s²: a body keeps its pose if its speed is below this value times the step, before the
// step and after it. So bodies at rest keep their poses to the bit. The effect equals a rolling
// resistance of one per cent: a body that would start to roll on a slope of half a degree stays.
inline constexpr double kResting = 0.1;

// Stores the velocity of the model's origin, computed from the velocity of one of the model's
// points.
void StoreMotion(const geometry::Pose& world_from_model, const geometry::Vector3& point,
                 const geometry::Vector3& velocity, const geometry::Vector3& angular_velocity,
                 world::BodyState& body);

}  // namespace gsv::dynamics
