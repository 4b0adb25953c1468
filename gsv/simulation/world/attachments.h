// Keeps the attachments of the engine in step with the bodies that devices hold.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

class Attachments {
 public:
  // Gives `layout` to `engine`, with the attachments of `state`.
  base::Status SetLayout(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state, dynamics::Engine& engine);
  // Attaches and detaches the bodies whose attachment has changed since the last call. `layout` is
  // that of the engine.
  void Follow(const world::Layout& layout, const world::State& state, dynamics::Engine& engine);

 private:
  std::vector<dynamics::Attachment> attached_;  // the attachments that the engine has
};

}  // namespace gsv::simulation
