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
  // state.step and state.time are the caller's. `contacts` becomes those at t + step, in the order
  // of (first, second), with `began` set by comparing with BodyState::in_contact and the contacts
  // of the step before; given the same vector again, it keeps its memory.
  virtual void Step(base::SimTime step, world::State& state,
                    std::vector<world::Contact>& contacts) = 0;

  // Pairs of bodies, at least one of them a robot, that overlap in `state` (by more than
  // `tolerance` metres): two robots at one place, a robot inside a wall.
  virtual std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) = 0;

  // Those of them that one body has part in: much cheaper than all. Of an object those as well of
  // which no robot is a part: objects in each other or in walls. Two that stand still for good may
  // overlap, and nothing is known of what is inside of a mesh and touches its surface nowhere.
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

}  // namespace gsv::dynamics
