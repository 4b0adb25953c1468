// Has the engine attach the bodies that devices hold to the robots that hold them.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

class Attachments {
 public:
  // Has `engine` move the bodies of `layout`, with what is held in `state`.
  base::Status SetLayout(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state, dynamics::Engine& engine);
  // Attaches and detaches what has changed since; `layout` is the engine's.
  void Follow(const world::Layout& layout, const world::State& state, dynamics::Engine& engine);

 private:
  std::vector<dynamics::Attachment> attached_;  // as the engine knows them
};

}  // namespace gsv::simulation
