// Remembers a step in which no rigid body moved, so that the same step need not be taken again.
// Private to this folder: it includes Bullet.
//
// Determinism  it only spares a step whose outcome is known; no outcome depends on it.
#pragma once

#include <vector>

#include "gsv/dynamics/rigid/rigid_scene.h"

namespace gsv::dynamics {

class RestingState {
 public:
  void Forget() { rests_ = false; }

  // After a step of so many seconds from `before` to `after`, with areas that the rigid bodies may
  // have reached.
  void Remember(const RigidScene& scene, const world::State& before, const world::State& after,
                double seconds, std::vector<Area> areas);

  // Whether a step would change nothing: all is as it was, and no planar body is near.
  bool Holds(const RigidScene& scene, const world::State& before, const world::State& after,
             double seconds) const;

 private:
  bool rests_ = false;
  double seconds_ = 0;
  std::vector<double> state_;
  std::vector<Area> areas_;
};

}  // namespace gsv::dynamics
