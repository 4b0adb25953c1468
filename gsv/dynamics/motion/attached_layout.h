// Converts a layout with attachments to the layout that engines use. The shapes of an attached body
// belong to the link that holds it. The attached body itself is static and collides with nothing.
//
// Determinism  the outcome depends on which attachments there are, not on the order in which they
//              were made.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"

namespace gsv::dynamics {

class AttachedLayout {
 public:
  // Removes all attachments.
  void Reset(std::shared_ptr<const world::Layout> layout);

  // The same as the functions of Engine.
  base::Status Attach(const Attachment& attachment, const world::State& state);
  void Detach(int held_body);

  // Returns the layout with all attachments if they have changed since the last call or Reset();
  // else null.
  std::shared_ptr<const world::Layout> TakeChanged();

 private:
  struct Held {
    Attachment attachment;
    std::vector<geometry::Pose> held_from_links;
  };

  base::Status Check(const Attachment& attachment) const;
  bool IsHeld(int body) const;
  bool IsHolder(int body) const;
  std::shared_ptr<const world::Layout> Derive() const;

  std::shared_ptr<const world::Layout> layout_;
  std::vector<Held> held_;  // ordered by holder, link and held body
  bool has_changed_ = false;
};

}  // namespace gsv::dynamics
