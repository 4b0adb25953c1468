// An engine of rigid-body dynamics, as WorldEngine uses it. rigid/ implements it with Bullet.
//
// Bodies       those of kind kRigidBody are its own. It finds all others in the states that it is
//              given: planar bodies and actors move during a step, the rest stands.
// Attachments  reach it as another layout, in which the shapes of the held body belong to the link
//              that holds it and the held body is static (AttachedLayout).
// Threads      one thread at a time.
// Determinism  Step() is a function of the layout, its arguments and nothing else. An engine that
//              must remember something from step to step keeps it in State::engine, which is
//              hashed. It is null after a change of the layout, unless only attachments
//              changed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// A planar robot that pushes a rigid body: a force at one point that holds the body's speed there,
// never pulls, and has a limit.
struct Push {
  int robot = 0, object = 0;  // bodies in the layout
  geometry::Vector3 point;    // world; the engine chooses z where the two face each other
  double low = 0;             // z (m) above which the robot pushes
  geometry::Vector3 normal;   // world, unit length, from the robot to the body
  double speed = 0;           // m/s along the normal, above 0
  double force = 0;           // N: the limit
  double start = 0;           // s into the step: when the robot gets there

  // Results.
  double achieved = 0;  // m/s along the normal: of the body's point after the step
  double impulse = 0;   // N s over the step
};

class RigidEngine {
 public:
  virtual ~RigidEngine() = default;

  // Prepares for another set of bodies. Refuses drives that make no sense (kBadModel).
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;

  // Whether the layout holds bodies of its own. Without any, nothing below is called.
  virtual bool has_bodies() const = 0;

  // Takes the rigid bodies of `state`, which are as in `before`, from before.time to before.time +
  // step: poses, velocities, joints, drives, distances. Planar bodies are in `before` where the
  // step starts and in `state` where it ends. Fills in the results of `pushes`.
  //
  // Replaces `contacts` by the contacts of rigid bodies in this step, with their points and
  // impulses (of the contact, and of each point with friction), in any order. The first body of a
  // contact is rigid. `began` says that the two did not touch when the step started. A pair has at
  // most two contacts. One of them `supports`: it has the points at which the second body, static or
  // planar, carries the first from below, as the ground does.
  virtual void Step(base::SimTime step, const world::State& before, std::span<Push> pushes,
                    world::State& state, std::vector<world::Contact>& contacts) = 0;

  // The bodies that overlap `body` in `state` by more than `tolerance` metres, if one of the two is
  // rigid, ordered by (first, second). Sets only the pair and the depth of each contact.
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

}  // namespace gsv::dynamics
