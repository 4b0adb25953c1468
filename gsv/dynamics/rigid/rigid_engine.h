// The engine of what moves by forces: Bullet, in double precision.
//
// Who moves   bodies that are rigid (world::Body::is_rigid) and not static. Static ones stand;
// those
//             that the planar mover moves are obstacles that nothing moves, and push.
// Accuracy    substeps of at most 1 ms, shorter where something moves by more than 0.4 of its half
//             thickness in one; contacts and friction are solved until no impulse changes by more
//             than 1e-8 N s (or 1,000 rounds). Bodies rest 10 µm deep in each other.
//             With more than five bodies there are fewer rounds: 5,000 over their number, 50 at
//             least.
// At rest     what neither moves nor accelerates by more than 0.1 m/s² keeps its place to the bit.
//             While all rest, a step costs next to nothing.
//
// Threads     one thread at a time.
// Determinism Step() is a function of the layout, the states and the step size alone: Bullet's
// world
//             is built anew for each step. See docs/adr/012-bullet-world-of-one-step.md.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

struct Push;

class RigidEngine {
 public:
  RigidEngine();
  ~RigidEngine();

  // Refuses drives that make no sense.
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);
  // Without any, there is nothing to step.
  bool has_bodies() const;

  // Takes the rigid bodies of `state` from its time t to t + step. Where `before` has the planar
  // bodies at t, `state` has them at t + step already, stopped by the rigid ones as they were at t,
  // with their `contacts`. True if they pushed any: then the caller is to move them once more, from
  // t, past the rigid bodies as they are now.
  bool Move(base::SimTime step, const world::State& before,
            const std::vector<world::Contact>& contacts, world::State& state);
  // After that: robots that pushed go on as fast as what they pushed.
  void GoOn(base::SimTime step, const world::State& before, world::State& state) const;
  // What overlaps `body` in `state` by more than `tolerance` metres, as far as one of the two moves
  // by forces, by (first, second). Of each contact only the pair and the depth are told.
  std::vector<world::Contact> OverlapsOf(const world::State& state, int body, double tolerance);
  // Adds the contacts of the rigid bodies in Move() to those of the planar ones.
  void AddContacts(const world::State& before, world::State& state,
                   std::vector<world::Contact>& contacts);

 private:
  struct Parts;

  void FindPushes(base::SimTime step, const world::State& before,
                  const std::vector<world::Contact>& contacts, const world::State& state);

  std::unique_ptr<Parts> parts_;
};

}  // namespace gsv::dynamics
