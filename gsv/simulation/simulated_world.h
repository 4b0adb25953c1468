// The world that a simulation moves: who stands in it, the state, and the engine.
//
// Threads  who calls a member other than lock() holds lock().
#pragma once

#include <memory>
#include <string>

#include "gsv/dynamics/motion/engine.h"
#include "gsv/simulation/attachments.h"
#include "gsv/simulation/world_lock.h"
#include "gsv/world/wheel_odometry.h"

namespace gsv::simulation {

class SimulatedWorld {
 public:
  // The world starts at the initial state of `layout`, which `engine` has been given.
  SimulatedWorld(std::unique_ptr<dynamics::Engine> engine,
                 std::shared_ptr<const world::Layout> layout);

  WorldLock& lock() const { return lock_; }

  const std::shared_ptr<const world::Layout>& layout() const { return layout_; }
  world::State& state() { return state_; }
  const world::State& state() const { return state_; }
  dynamics::Engine& engine() { return *engine_; }
  // world_from_model of the body of that name, which is there.
  const geometry::Pose& PoseOf(const std::string& body) const {
    return state_.bodies[static_cast<std::size_t>(layout_->Find(body))].world_from_model;
  }

  // Has the engine move the bodies of `layout`, with what `state` says is held. A layout that is
  // tried only is followed by Replace() or Restore().
  base::Status TryLayout(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state) {
    return attachments_.SetLayout(layout, state, *engine_);
  }
  base::Status Restore() { return TryLayout(layout_, state_); }
  base::Status Replace(std::shared_ptr<const world::Layout> layout, world::State state);
  // Back to the initial state.
  void Reset();

  // Has the engine attach and detach what devices have grasped and released since the last step.
  void FollowAttachments() { attachments_.Follow(*layout_, state_, *engine_); }
  // Moves the world by one step. `snapshot` becomes the state after it; its memory is used again.
  void Step(base::SimTime step, world::Snapshot& snapshot);
  world::Snapshot InitialSnapshot() const { return {layout_, state_, {}, {}, {}}; }

 private:
  mutable WorldLock lock_;
  // Guarded by lock_.
  std::unique_ptr<dynamics::Engine> engine_;
  std::shared_ptr<const world::Layout> layout_;
  world::State state_;
  Attachments attachments_;
  world::WheelOdometry wheel_odometry_;
};

}  // namespace gsv::simulation
