// An engine moves the bodies of a world by one step.
//
// Threads      one thread at a time (the stepping thread).
// Determinism  Step() is a function of the layout, the attachments (not of their order), the state
//              and the step size. Data that an engine keeps between calls must not change the
//              result.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// A body that a link of another body carries, as a gripper carries a grasped body. Bodies are
// indices in the layout.
struct Attachment {
  int holder_body = 0;            // the body that carries
  int holder_link = 0;            // index of the carrying link in the holder's model
  int held_body = 0;              // the body that is carried
  geometry::Pose link_from_held;  // pose of the held model's frame in the frame of this link
};

// Is notified of the motion of bodies in Engine::StepMany().
class MotionFollower {
 public:
  virtual ~MotionFollower() = default;
  // A body has moved by `steps` steps, and `steps_left` further steps follow. If `steps` is above 1,
  // its joints did not move, and its velocity was constant: equal in these steps and in the step
  // before. `may_touch` is true if the body may have contacts. Threads: calls for different bodies
  // may run concurrently if `may_touch` is false.
  virtual void OnMoved(int body, int steps, int steps_left, bool may_touch) = 0;
  // The contacts of the last step are complete, and all bodies that may have contacts have taken all
  // steps. Threads: other bodies may still move.
  virtual void OnContacts() {}
};

// The interface of a physics engine.
class Engine {
 public:
  virtual ~Engine() = default;

  // Prepares for another set of bodies, without attachments. It must be called before the first
  // Step() and after each change of the set of bodies. If SetLayout() fails, another layout must be
  // set before anything else is called.
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;

  // Makes the collision shapes of the held body a part of the holder's link. The engine no longer
  // moves the held body: the caller writes its pose into the state. The held body adds no mass, and
  // its joints keep their positions in `state`. All attachments and detachments since the last
  // Step(), Overlaps() or OverlapsOf() cost together as much as one SetLayout().
  //
  // Returns kInvalidArgument if a body or the link does not exist, or if the holder is static or
  // itself held. The same applies if the held body is not rigid, holds a body itself, or is already
  // held.
  virtual base::Status Attach(const Attachment& attachment, const world::State& state) = 0;
  // Ends the attachment: the engine moves the body again, from its pose in the state. Does nothing
  // if the body is not attached.
  virtual void Detach(int held_body) = 0;

  // Advances `state`, which must match the layout, from its time t to t + step. Drives follow their
  // commands within their limits, bodies do not overlap, and wheel joints turn. The caller sets
  // state.step and state.time. Replaces `contacts` by the contacts at t + step, in the order of
  // (first, second, supports). To set `began`, the engine reads BodyState::in_contact and the
  // contacts of the previous step. Pass the same vector in each step to avoid memory allocations.
  virtual void Step(base::SimTime step, world::State& state,
                    std::vector<world::Contact>& contacts) = 0;

  // Advances `state` by `count` >= 2 steps at once, with the same result as `count` calls of
  // Step(). `contacts` are those at the end of the last step. `follower` is notified of each planar
  // body after its steps; other bodies do not move. The order of bodies is undefined, so
  // the state of other bodies must not be read. state.time stays at the start of the first step.
  // Returns false and changes nothing if the engine cannot, or if single steps are faster.
  virtual bool StepMany(base::SimTime /*step*/, int /*count*/, world::State& /*state*/,
                        std::vector<world::Contact>& /*contacts*/, MotionFollower& /*follower*/) {
    return false;
  }

  // Returns the pairs of bodies that overlap in `state` by more than `tolerance` metres, if at
  // least one of the two is a robot. Examples are two robots at one position, and a robot inside a
  // wall.
  virtual std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) = 0;

  // Returns the overlaps of one body, which costs much less than Overlaps(). For an object, these
  // include overlaps with other objects and with walls. Two static bodies may overlap. The function
  // does not detect a body that is inside a mesh and does not touch its surface.
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

}  // namespace gsv::dynamics
