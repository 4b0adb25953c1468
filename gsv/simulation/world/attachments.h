// Attaches bodies to devices in the engine, as the state of the devices requires.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

// Attaches grasped bodies to their grippers in the engine.
class Attachments {
 public:
  // Sets the layout of `engine`, with the attachments of `state`.
  base::Status SetLayout(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state, dynamics::Engine& engine);
  // Attaches and detaches the bodies whose attachment has changed since the last call. `layout`
  // must be the engine's.
  void Follow(const world::Layout& layout, const world::State& state, dynamics::Engine& engine);

 private:
  std::vector<dynamics::Attachment> attached_;  // attachments in the engine
};

}  // namespace gsv::simulation
