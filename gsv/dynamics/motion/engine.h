// An engine moves the bodies of a world by one step.
//
// Threads      one thread at a time (the stepping thread).
// Determinism  Step() is a function of the layout, the attachments (in whatever order they were
//              made), the state and the step size alone; nothing that it keeps between calls may
//              change the outcome.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// A body that a link of another body carries, as a gripper carries a grasped body. Bodies are
// indices in the layout.
struct Attachment {
  int holder_body = 0;
  int holder_link = 0;  // a link of the holder's model
  int held_body = 0;
  geometry::Pose link_from_held;  // pose of the held model's frame
};

class Engine {
 public:
  virtual ~Engine() = default;

  // Prepares for another set of bodies, without attachments. Called before the first Step() and
  // after each change. If it fails, another layout must be set before anything else is called.
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;

  // From the next call on, the collision shapes of the held body are part of the holder's link, and
  // the engine does not move the body: the caller writes its pose into the state. It adds no mass.
  // Its joints keep their positions in `state`. Costs as much as SetLayout(), once for all that was
  // attached and detached since the last Step(), Overlaps() or OverlapsOf().
  //
  // Refuses (kInvalidArgument) a body or link that does not exist, a held body that rigid-body
  // dynamics does not move or that already holds or is held, and a holder that is static or held.
  virtual base::Status Attach(const Attachment& attachment, const world::State& state) = 0;
  // The body moves by itself again, from its pose in the state. Ignored if it is not attached.
  virtual void Detach(int held_body) = 0;

  // Advances `state`, which fits the layout, from its time t to t + step: drives follow their
  // commands within their limits, bodies do not overlap, wheel joints turn. The caller sets
  // state.step and state.time. Replaces `contacts` by the contacts at t + step, in the order of
  // (first, second, supports). `began` compares with BodyState::in_contact and the contacts of the
  // step before. A vector that is passed again keeps its memory.
  virtual void Step(base::SimTime step, world::State& state,
                    std::vector<world::Contact>& contacts) = 0;

  // Pairs of bodies, at least one of them a robot, that overlap in `state` (by more than
  // `tolerance` metres): two robots at one place, a robot inside a wall.
  virtual std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) = 0;

  // The overlaps of one body, which cost much less than all. For an object they include overlaps
  // with other objects and with walls. Two static bodies may overlap. A body inside a mesh that does
  // not touch the mesh's surface is not detected.
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

}  // namespace gsv::dynamics
