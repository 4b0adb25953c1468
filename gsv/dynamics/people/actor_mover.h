// Moves the actors of a world along their scripts.
//
// Animations    the joints have the positions of the current frame. The frame follows from the
//               time. For an animation by distance, the frame follows from the distance travelled
//               since the trajectory's start, divided by the distance that the animation covers.
// Velocities    the mean over the step. An actor whose script restarts or changes its trajectory
//               at another place jumps: its velocity is zero in that step, and it touches nothing
//               between the two places.
// Threads       one thread at a time.
// Determinism   an actor's pose is a function of its initial pose, its script and the time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/people/script_pose.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// Moves actors along their scripts. No obstacle stops an actor.
class ActorMover {
 public:
  // Finds the actors of a new layout.
  void SetLayout(const std::shared_ptr<const world::Layout>& layout);

  // Writes the poses and velocities of the actors at state.time + step. `before` is the state
  // at the start of the step, or null. An actor that jumps gets its pose after the jump in
  // `before`, too, so that it touches nothing between the two places.
  void Move(base::SimTime step, world::State& state, world::State* before) const;

 private:
  // An actor of the layout, with the data that are computed once from its script.
  struct Actor {
    int body = 0;                           // index of the body in the layout
    const model::Script* script = nullptr;  // never null
    geometry::Pose world_from_trajectory;   // pose of the frame in which waypoints are given
    int first_joint = 0;  // index of the actor's first joint in State::joint_positions
    // for each trajectory: distances from the start, at equal times between waypoints, m
    std::vector<std::vector<double>> ways;
  };
  // Writes the pose and joint positions that the actor has at this instant of its script.
  static void Pose(const Actor& actor, const ScriptInstant& instant, world::State& state);

  std::shared_ptr<const world::Layout> layout_;  // keeps the scripts alive
  std::vector<Actor> actors_;
};

}  // namespace gsv::dynamics
