// Moves the actors of a world along their scripts.
//
// Animations    the joints have the positions of the frame whose time has come; by distance, of the
//               share that the way since the trajectory's start is of the one that the animation
//               covers.
// Velocities    the mean over the step. An actor that jumps, because its script begins anew
//               elsewhere, has none in that step, and hits nothing on its way.
// Threads       one thread at a time.
// Determinism   an actor's pose is a function of its initial pose, its script and the time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/people/script_pose.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

class ActorMover {
 public:
  void SetLayout(const std::shared_ptr<const world::Layout>& layout);

  // Writes the poses and velocities of the actors at state.time + step. `before`, unless it is
  // null, is the state at the step's start. In it, actors that jump get the pose at which they
  // arrive.
  void Move(base::SimTime step, world::State& state, world::State* before) const;

 private:
  struct Actor {
    int body = 0;
    const model::Script* script = nullptr;
    geometry::Pose world_from_trajectory;
    int first_joint = 0;
    std::vector<std::vector<double>> ways;  // by trajectory, see WaysAlong()
  };
  static void Pose(const Actor& actor, const ScriptInstant& instant, world::State& state);

  std::shared_ptr<const world::Layout> layout_;  // keeps the scripts
  std::vector<Actor> actors_;
};

}  // namespace gsv::dynamics
