// The world of a simulation: its layout, state and engine.
//
// Threads  any. Functions with GSV_REQUIRES(world_mutex) may be called only while lock() is locked.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/engine.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/simulation/world/attachments.h"
#include "gsv/simulation/world/world_lock.h"
#include "gsv/world/wheel_odometry.h"

namespace gsv::simulation {

// The current layout and state of a simulated world, and the engine that moves it.
class SimulatedWorld {
 public:
  // The world starts in the initial state of `layout`, which must be the engine's layout. In a
  // large world, Step() processes the bodies in parallel on `team`.
  SimulatedWorld(std::unique_ptr<dynamics::Engine> engine,
                 std::shared_ptr<const world::Layout> layout,
                 std::shared_ptr<base::ThreadTeam> team);

  WorldLock& lock() const { return lock_; }

  const std::shared_ptr<const world::Layout>& layout() const GSV_REQUIRES(world_mutex) {
    return layout_;
  }
  world::State& state() GSV_REQUIRES(world_mutex) { return state_; }
  const world::State& state() const GSV_REQUIRES(world_mutex) { return state_; }
  dynamics::Engine& engine() GSV_REQUIRES(world_mutex) { return *engine_; }
  // Returns world_from_model of the body with that name, which must exist.
  const geometry::Pose& PoseOf(const std::string& body) const GSV_REQUIRES(world_mutex) {
    return state_.bodies[static_cast<std::size_t>(layout_->Find(body))].world_from_model;
  }

  // Sets the engine's layout, with the attachments of `state`. Call Replace() if this succeeds, and
  // Restore() if it fails.
  base::Status TryLayout(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state) GSV_REQUIRES(world_mutex) {
    return attachments_.SetLayout(layout, state, *engine_);
  }
  // Sets the engine's layout back to the current layout, after TryLayout() failed.
  base::Status Restore() GSV_REQUIRES(world_mutex) { return TryLayout(layout_, state_); }
  // Makes this layout and this state the current ones.
  base::Status Replace(std::shared_ptr<const world::Layout> layout, world::State state)
      GSV_REQUIRES(world_mutex);
  // Sets the initial state.
  void Reset() GSV_REQUIRES(world_mutex);

  // Attaches and detaches the bodies that devices have grasped and released since the last step.
  void FollowAttachments() GSV_REQUIRES(world_mutex) {
    attachments_.Follow(*layout_, state_, *engine_);
  }
  // Moves the world by one step, or by `max_steps` steps at once if the engine can do this. Writes
  // the new state to `snapshot`, whose memory is reused. Returns the number of steps. If this is
  // above 1, all bodies are also placed in `scene`, unless it is null.
  int Step(base::SimTime step, int max_steps, world::Snapshot& snapshot, sensing::SceneDraft* scene)
      GSV_REQUIRES(world_mutex);
  world::Snapshot InitialSnapshot() const GSV_REQUIRES(world_mutex) {
    return {layout_, state_, {}, {}, {}};
  }

 private:
  // Moves the world by several steps at once. Returns false if the engine cannot do this.
  bool StepMany(base::SimTime step, int steps, world::Snapshot& snapshot,
                sensing::SceneDraft* scene) GSV_REQUIRES(world_mutex);
  // Copies everything except the bodies.
  void CopyAllButBodies(world::State& to) GSV_REQUIRES(world_mutex);
  // Completes the step that the engine has computed, and copies the state to `snapshot`.
  void FinishStep(double step_seconds, world::Snapshot& snapshot) GSV_REQUIRES(world_mutex);

  mutable WorldLock lock_;
  std::unique_ptr<dynamics::Engine> engine_ GSV_GUARDED_BY(world_mutex);
  std::shared_ptr<const world::Layout> layout_ GSV_GUARDED_BY(world_mutex);
  world::State state_ GSV_GUARDED_BY(world_mutex);
  // Bodies that are attached to grippers.
  Attachments attachments_ GSV_GUARDED_BY(world_mutex);
  world::WheelOdometry wheel_odometry_ GSV_GUARDED_BY(world_mutex);
  const std::shared_ptr<base::ThreadTeam> team_;
};

}  // namespace gsv::simulation
