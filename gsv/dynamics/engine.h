// What moves the bodies of a world by one step.
//
// Threads      one thread at a time (the stepping thread).
// Determinism  Step() is a function of the layout, the state and the step size alone; nothing that
//              it keeps between calls may change the outcome.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

class Engine {
 public:
  virtual ~Engine() = default;

  // Prepares for another set of bodies. Called before the first Step() and after each change.
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;

  // Takes `state`, which fits the layout, from its time t to t + step: drives follow their
  // commands within their limits, bodies do not enter each other, joints of wheels turn.
  // state.step and state.time are the caller's. Returns the contacts at t + step, in the order of
  // (first, second), with `began` set by comparing with BodyState::in_contact and the contacts of
  // the step before.
  virtual std::vector<world::Contact> Step(base::SimTime step, world::State& state) = 0;

  // Pairs of bodies, at least one of them a robot, that overlap in `state` (by more than
  // `tolerance` metres): two robots at one place, a robot inside a wall.
  virtual std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) = 0;
};

}  // namespace gsv::dynamics
