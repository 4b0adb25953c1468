// Takes a step of all rigid bodies of a scene. Private to this folder: it includes Bullet.
//
// Determinism  a step is a function of the scene, the states and the step size alone. Data that is
//              kept from step to step does not change the result.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/rigid_engine.h"
#include "gsv/dynamics/rigid/island_solver.h"
#include "gsv/dynamics/rigid/kept_impulses.h"
#include "gsv/dynamics/rigid/rigid_contacts.h"

namespace gsv::dynamics {

// Takes a step of all rigid bodies of a scene.
class RigidStep {
 public:
  // `team` may be null, must outlive this object, and does not change results.
  explicit RigidStep(base::ThreadTeam* team) : team_(team) {}

  // Sets the scene of the next steps. It must exist until the next call, or as long as this object.
  void SetScene(const RigidScene& scene);

  // Runs a step from `before`. In `after`, the planar bodies have their poses at the end of the
  // step.
  void Run(const world::State& before, const world::State& after, double seconds,
           std::span<Push> pushes, RigidContacts& contacts);
  // Call it after Run(): writes the poses and velocities of the rigid bodies, and the impulses with
  // which the next step starts.
  void Store(world::State& state) const;
  // Call it after Run(): returns the areas that the rigid bodies may reach in a step of the same
  // length.
  std::vector<Area> MakeAreas() const;

  // Takes no step. Returns the overlaps of `body` in `state` of more than `tolerance` metres,
  // ordered by (first, second), with one contact for each pair.
  std::vector<world::Contact> OverlapsOf(const world::State& state, int body, double tolerance);

 private:
  // A planar body near rigid bodies, and its motion in the step.
  struct Planar {
    const Solid* solid;
    geometry::Pose start;      // pose at the start of the step
    geometry::Vector3 travel;  // change of position in the step, m
    double turn;               // rotation about z in the step, rad
  };
  // A push, with its state during the step.
  struct ActivePush {
    int push = 0;                     // index in the caller's list
    PushRow row;                      // the row of the present substep
    geometry::Vector3 point_in_body;  // the pushed point, in the frame of the pushed body's base
    bool has_started = false;         // whether the push acts: its Push::start was reached
    double impulse = 0;               // impulse so far in the step, N s
  };

  // Loads the bodies and finds the planar bodies near them.
  void Start(const world::State& before, const world::State& after, double seconds);
  // Adds the planar bodies that may touch a rigid body in this step.
  void AddPlanarNear(const world::State& before, const world::State& after);
  // Moves the planar bodies near rigid bodies to their poses at `time` after the start of the step.
  void MovePlanar(double time);
  // Prepares the pushes of the step.
  void AddPushes(std::span<const Push> pushes);
  // Returns the length of the next substep, if `left` seconds of the step are left.
  double SubstepFor(double left) const;
  // Finds and solves the contacts of a substep, and moves the bodies to its end.
  void TakeSubstep(double time, double substep, std::span<const Push> pushes,
                   RigidContacts& contacts);
  // Prepares the rows of the pushes for a substep.
  void StartPushes(std::span<const Push> pushes, double time, double substep);
  // Lists the islands: groups of bodies that act on each other.
  void MakeIslands();
  // Merges the islands of two bodies.
  void Join(int a, int b);
  // Returns the body that represents the island of a body.
  int RootOf(int moving);
  // Solves each island for a substep.
  void SolveIslands(double substep);
  // Stores the impulses of heaps for the next substep.
  void KeepImpulses(double substep);
  // Moves all bodies to the end of a substep.
  void MoveBodies(double substep);
  // Returns the moving body on which impulses on a collider act, or -1.
  int MovedBy(int collider) const;
  template <typename Work>
  void ForEachBody(const Work& work);

  base::ThreadTeam* team_;
  const RigidScene* scene_ = nullptr;
  double seconds_ = 0;  // length of the step
  std::vector<std::unique_ptr<MovingBody>> bodies_;
  ContactFinder finder_;
  std::vector<Contact>* contacts_ = nullptr;  // contacts of the finder in this substep
  std::vector<Planar> planar_;
  std::vector<ActivePush> pushes_;
  std::vector<PushRow> push_rows_;  // the rows of pushes_ in this substep
  // for each moving body: its parent in the union-find structure, and its island
  std::vector<int> parents_, islands_of_;
  std::deque<IslandSolver> islands_;  // memory for the largest number of islands so far
  std::size_t island_count_ = 0;
  std::vector<int> starts_;         // index of each body's first velocity
  std::vector<double> velocities_;  // velocities of all moving bodies at the end of the substep
  std::vector<geometry::Vector3> shifts_;  // velocities that separate overlapping bodies, m/s
  std::vector<char> is_touched_;           // for each moving body, whether a contact acts on it
  // state at the start of the step; may be null
  std::shared_ptr<const world::EngineState> kept_before_;
  std::shared_ptr<KeptImpulses> kept_;  // impulses of the last substep; may be null
};

}  // namespace gsv::dynamics
