// An engine of rigid-body dynamics, as WorldEngine uses it. rigid/ implements it.
//
// Bodies       the engine moves the bodies of kind kRigidBody. It reads all others from the states:
//              planar bodies and actors move during a step, and the rest is static.
// Attachments  are given to it as another layout, in which the shapes of the held body belong to
//              the link that holds it, and the held body is static (AttachedLayout).
// Threads      one thread at a time.
// Determinism  Step() is a function of only the layout and its arguments. Data that an
//              engine needs from the previous step are in State::engine, which is
//              hashed. It is null after a change of the layout, unless only attachments
//              changed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// A planar robot that pushes a rigid body: a force at one point that gives the body's point the
// robot's speed. The force is limited and never pulls.
struct Push {
  int robot = 0, object = 0;  // indices of the bodies in the layout
  geometry::Vector3 point;    // in the world; the engine chooses z where the two face each other
  double low = 0;             // the robot pushes above this z, m
  geometry::Vector3 normal;   // in the world, unit length, from the robot to the body
  double speed = 0;           // speed of the robot along the normal, m/s, > 0
  double force = 0;           // maximum force, N
  double start = 0;           // time from the start of the step to the contact, s

  // Results.
  double achieved = 0;  // speed of the body's point along the normal after the step, m/s
  double impulse = 0;   // impulse over the step, N s
};

class RigidEngine {
 public:
  virtual ~RigidEngine() = default;

  // Prepares for another set of bodies. Returns kBadModel for invalid drives.
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;

  // Whether the layout has bodies that this engine moves. Otherwise nothing below is called.
  virtual bool has_bodies() const = 0;

  // Moves the rigid bodies of `state`, which are as in `before`, from before.time to before.time +
  // step: poses, velocities, joints, drives, distances. Planar bodies have their start of the step
  // in `before` and its end in `state`. Sets the results of `pushes`.
  //
  // Replaces `contacts` by the contacts of rigid bodies in this step, with their points and
  // impulses (of the contact, and of each point with friction), in any order. The first body of a
  // contact is rigid. `began` means that the two did not touch at the start of the step. A pair has
  // at most two contacts. One of them has `supports`: its points are those at which the second
  // body, static or planar, carries the first from below, as the ground does.
  virtual void Step(base::SimTime step, const world::State& before, std::span<Push> pushes,
                    world::State& state, std::vector<world::Contact>& contacts) = 0;

  // Returns the bodies that overlap `body` in `state` by more than `tolerance` metres, if one of
  // the two is rigid, ordered by (first, second). Sets only the pair and the depth of each contact.
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

}  // namespace gsv::dynamics
