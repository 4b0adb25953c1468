// Makes the list of contacts of a step: one for each pair of bodies, ordered by (first, second).
#pragma once

#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// The indices of two bodies in the layout.
struct BodyPair {
  int first, second;
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

// Collects the contacts of one step, one for each pair of bodies.
class ContactCollector {
 public:
  // Clears and fills `contacts`. Bodies further apart than `gap` have no contact. If `gap` is below
  // 0, bodies that overlap by less than -gap have no contact.
  ContactCollector(std::vector<world::Contact>& contacts, double gap);

  // Passes the separation of a piece of the first body from a piece of the second body. A pair of
  // bodies gets the contact of its deepest piece. Among equally deep pieces, it is the contact of
  // the piece that was passed first. Pass all pieces of one first body before those of the next.
  void Offer(const BodyPair& bodies, const Separation& separation, double height);

  // Sorts the contacts and sets `began` for pairs that are not in `touching`. `touching` must be in
  // ascending order.
  void Finish(const std::vector<BodyPair>& touching);

 private:
  std::vector<world::Contact>& contacts_;
  double gap_;  // see the constructor
};

}  // namespace gsv::dynamics
