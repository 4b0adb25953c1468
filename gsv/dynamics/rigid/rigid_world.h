// Bullet's world for the length of one step. Private to this folder: it includes Bullet.
//
// Determinism  it is built anew for each step, everything in the order of the layout, so that no
//              cache of Bullet's outlives a step: what comes out is a function of the scene, the
//              states and the step size alone.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "gsv/dynamics/motion/rigid_engine.h"
#include "gsv/dynamics/rigid/collision_kinds.h"
#include "gsv/dynamics/rigid/impulse_solver.h"
#include "gsv/dynamics/rigid/moving_body.h"
#include "gsv/dynamics/rigid/push_constraint.h"
#include "gsv/dynamics/rigid/rigid_contacts.h"
#include "gsv/dynamics/rigid/rigid_scene.h"

namespace gsv::dynamics {

// Settings and memory pools, which may be kept from step to step.
struct BulletKit {
  explicit BulletKit(base::ThreadTeam* team);  // may be null
  CollisionKinds configuration;
  btCollisionDispatcher dispatcher;
  ImpulseSolver solver;
};

class RigidWorld {
 public:
  // `before` is the state at the start of the step. In `after`, the planar bodies have the poses of
  // its end.
  RigidWorld(BulletKit& kit, const RigidScene& scene, const world::State& before,
             const world::State& after, double seconds);
  ~RigidWorld();

  // Takes the step.
  void Run(std::span<Push> pushes, RigidContacts& contacts);
  // Takes none: what overlaps `body` by more than `tolerance` metres at the start, by (first,
  // second), one contact for each pair.
  std::vector<world::Contact> OverlapsOf(int body, double tolerance);
  // Writes where the rigid bodies are and how they move.
  void Store(world::State& state) const;
  // Returns the areas that the rigid bodies may reach in a step like this one.
  std::vector<Area> MakeAreas() const;

 private:
  struct Planar {
    geometry::Pose start;
    geometry::Vector3 travel;
    double turn;
    btRigidBody* object;
  };

  void AddRigid(const RigidBody& body);
  void AddStanding(const StandingBody& standing);
  void AddPlanarNear();
  void AddPlanar(const Solid& planar);
  void MovePlanar(double time, double substep);
  void AddPushes(std::span<const Push> pushes);
  void StartPushes(std::span<const Push> pushes, double time);
  double SubstepFor(double left) const;
  void TakeSubstep(double time, double substep, RigidContacts& contacts);
  Owner& NewOwner(const Solid& solid, bool is_rigid, bool is_held = false);

  BulletKit& kit_;
  const RigidScene& scene_;
  const world::State& before_;
  const world::State& after_;
  const double seconds_;

  std::deque<Owner> owners_;
  std::deque<FrictionAxes> friction_axes_;  // friction axes of contacts
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<std::unique_ptr<MovingBody>> bodies_;  // in the order of scene_.bodies()
  std::vector<Planar> planar_;
  std::vector<std::unique_ptr<PushConstraint>> pushes_;

  btDbvtBroadphase broad_phase_;
  btMultiBodyDynamicsWorld world_;  // goes before all that it holds
};

}  // namespace gsv::dynamics
