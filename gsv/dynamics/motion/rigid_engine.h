// The interface of an engine of rigid-body dynamics. WorldEngine uses it, and rigid/ implements it.
//
// Bodies       the engine moves the bodies of kind kRigidBody. It reads all others from the states:
//              planar bodies and actors move during a step, and all other bodies are static.
// Attachments  A change of attachments is a new layout (AttachedLayout). In this layout, the shapes
//              of the held body belong to the link that holds it, and the held body is static.
// Threads      one thread at a time.
// Determinism  Step() is a function of only the layout and its arguments. Data that an engine needs
//              from the previous step are in State::engine, which is hashed. State::engine is null
//              after a change of the layout, unless only attachments changed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// The push of a planar robot on a rigid body. A force at one point gives this point of the body the
// speed of the robot. The force is limited and never pulls.
struct Push {
  int robot = 0, object = 0;  // indices of the bodies in the layout
  // Contact point, world frame. The engine sets z to a height that both bodies have.
  geometry::Vector3 point;
  double low = 0;            // lowest z at which the robot pushes, m
  geometry::Vector3 normal;  // direction from the robot to the body, world axes, unit length
  double speed = 0;          // speed of the robot along the normal, m/s, > 0
  double force = 0;          // maximum force, N
  double start = 0;          // time from the start of the step to the contact, s

  // Results.
  double achieved = 0;  // speed of the body's point along the normal after the step, m/s
  double impulse = 0;   // impulse over the step, N s
};

// The interface of a physics engine that moves only rigid bodies.
class RigidEngine {
 public:
  virtual ~RigidEngine() = default;

  // Prepares for another set of bodies. Returns kBadModel for invalid drives.
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;

  // Whether the layout has bodies that this engine moves. If not, the functions below are not
  // called.
  virtual bool has_bodies() const = 0;

  // Moves the rigid bodies from before.time to before.time + step: poses, velocities, joints,
  // drives, distances. On entry, the rigid bodies in `state` must equal those in `before`. The
  // poses of planar bodies are in `before` for the start of the step, and in `state` for its end.
  // Sets the results of `pushes`.
  //
  // Replaces `contacts` by the contacts of rigid bodies in this step, in any order. The first body
  // of a contact is rigid. Each contact has its points, its impulse along the normal, and for each
  // point the impulse of normal force and friction. `began` means that the two bodies did not touch
  // at the start of the step. A pair has at most two contacts. One of them may have `supports`: at
  // its points, the second body carries the first from below, as the ground does. The second body
  // is then static, planar or an actor.
  virtual void Step(base::SimTime step, const world::State& before, std::span<Push> pushes,
                    world::State& state, std::vector<world::Contact>& contacts) = 0;

  // Returns the bodies that overlap `body` in `state` by more than `tolerance` metres, if one of
  // the two is rigid, ordered by (first, second). Sets only the pair and the depth of each contact.
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

}  // namespace gsv::dynamics
