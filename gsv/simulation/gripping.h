// Grippers of a simulation: what their jaws close on, they hold, and it goes where they go.
//
// Held         what is held collides as a part of the robot that holds it, wherever that link is
//              with its joints at zero; it weighs nothing then, and nothing else moves it.
// Determinism  a function of the snapshot and of what grippers were told; grippers act in the order
//              of their robots' names, so that of two that close on one thing the first gets it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Has jaws that close in the step of `step` from `now` take hold of what is between them.
// `state` is that of `now`.
void CloseJaws(const std::shared_ptr<const world::Snapshot>& now, base::SimTime step,
               sensing::RaySceneCache& rays, base::ThreadTeam* team, world::State& state);

// Lets go of what is not in the layout any more, and of what is among `placed`.
void LetGo(const world::Layout& layout, const std::vector<std::string>& placed,
           world::State& state);

// Puts what is held where its gripper is, moving as it does, and jaws of robots that no forces move
// where they are at `time`.
void CarryHeld(const world::Layout& layout, base::SimTime time, world::State& state);

// Who holds what; equal lists have equal layouts for the engine.
struct Hold {
  std::string robot, held;
  int link = 0;  // of the robot
  geometry::Pose link_from_held;
  friend bool operator==(const Hold&, const Hold&) = default;
};
std::vector<Hold> HoldsIn(const world::State& state);

// The layout as the engine is to see it: what is held is a part of who holds it.
std::shared_ptr<const world::Layout> WithHeld(const std::shared_ptr<const world::Layout>& layout,
                                              const world::State& state);

}  // namespace gsv::simulation
