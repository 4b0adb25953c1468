// Stores a step in which no rigid body moved, so that the same step need not be computed again.
// Private to this folder: it includes Bullet.
//
// Determinism  it only avoids a step whose result is known, so results do not depend on it.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/rigid/rigid_scene.h"

namespace gsv::dynamics {

// Detects that a step would change nothing, because all rigid bodies are at rest.
class RestingState {
 public:
  // Discards the stored step.
  void Forget() { rests_ = false; }

  // Call this after a step of `seconds` from `before` to `after`, with the areas that the rigid
  // bodies may have reached.
  void Remember(const RigidScene& scene, const world::State& before, const world::State& after,
                double seconds, std::vector<Area> areas);

  // Whether a step would change nothing: the state has not changed, and no planar body is near.
  bool Holds(const RigidScene& scene, const world::State& before, const world::State& after,
             double seconds) const;

 private:
  bool rests_ = false;         // whether a step without motion is stored
  double seconds_ = 0;         // length of the stored step
  std::vector<double> state_;  // poses, velocities and joints of the rigid bodies
  std::vector<Area> areas_;    // see Remember()
  std::shared_ptr<const world::EngineState> engine_;  // State::engine after the stored step
};

}  // namespace gsv::dynamics
