// Has the engine know what devices hold: a held body collides as a part of the robot that holds it,
// wherever that link is with its joints at zero; it weighs nothing then, and nothing else moves it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

class Attachments {
 public:
  // Has `engine` move the bodies of `layout`, with what is held in `state`.
  base::Status SetLayout(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state, dynamics::Engine& engine);
  // The same for the layout that the engine has, where what is held has changed since.
  void Follow(const std::shared_ptr<const world::Layout>& layout, const world::State& state,
              dynamics::Engine& engine);

 private:
  struct Hold {
    std::string robot;
    int link = 0;  // of the robot
    world::Grasp grasp;
    friend bool operator==(const Hold&, const Hold&) = default;
  };

  static std::vector<Hold> HoldsIn(const world::State& state);
  // The layout as the engine is to see it: what is held is a part of its holder.
  static std::shared_ptr<const world::Layout> WithHeld(
      const std::shared_ptr<const world::Layout>& layout, const std::vector<Hold>& holds,
      const world::State& state);

  std::vector<Hold> holds_;  // as the engine knows them
};

}  // namespace gsv::simulation
