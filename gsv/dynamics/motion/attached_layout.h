// Converts a layout with attachments to the layout that engines use. The shapes of an attached body
// belong to the link that holds it. The attached body itself is static and collides with nothing.
//
// Determinism  the result depends on the set of attachments, not on the order in which they were
//              made.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/motion/engine.h"

namespace gsv::dynamics {

// Stores a layout and its attachments, and derives the layout that engines use.
class AttachedLayout {
 public:
  // Sets a layout, and removes all attachments.
  void Reset(std::shared_ptr<const world::Layout> layout);

  // Attaches a body to a link, as Engine::Attach() does. engine.h describes the errors.
  base::Status Attach(const Attachment& attachment, const world::State& state);
  // Ends the attachment, as Engine::Detach() does.
  void Detach(int held_body);

  // Returns the layout with all attachments if they have changed since the last call or Reset();
  // else null.
  std::shared_ptr<const world::Layout> TakeChanged();

 private:
  // An attachment, with the poses of the held body's links when it was attached.
  struct Held {
    Attachment attachment;                        // see Engine::Attach()
    std::vector<geometry::Pose> held_from_links;  // in the frame of the held model
  };

  // Returns an error if the attachment is invalid, see Engine::Attach().
  base::Status Check(const Attachment& attachment) const;
  // Whether the body is attached to a link of another body.
  bool IsHeld(int body) const;
  // Whether another body is attached to a link of this body.
  bool IsHolder(int body) const;
  // Returns the layout in which the shapes of each held body belong to its holder.
  std::shared_ptr<const world::Layout> Derive() const;

  std::shared_ptr<const world::Layout> layout_;  // the layout of Reset(), without attachments
  std::vector<Held> held_;                       // ordered by holder, link and held body
  bool has_changed_ = false;  // whether attachments have changed since TakeChanged()
};

}  // namespace gsv::dynamics
