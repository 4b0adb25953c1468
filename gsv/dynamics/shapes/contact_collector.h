// Makes the list of contacts: one for each pair of bodies, by (first, second).
#pragma once

#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// Bodies' indices in the layout.
struct BodyPair {
  int first, second;
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

class ContactCollector {
 public:
  // Clears and fills `contacts`. Bodies further apart than `gap` have no contact. If `gap` is below
  // 0, bodies that overlap by less than -gap have none.
  ContactCollector(std::vector<world::Contact>& contacts, double gap);

  // Where a piece of the first lies to a piece of the second. Of the pieces of one pair of bodies
  // the deepest counts, of equals the first. Those of one first body are to be offered one after
  // the other.
  void Offer(const BodyPair& bodies, const Separation& separation, double height);

  // Sorts, and says which contacts began: those of pairs not in `touching`, which is ascending.
  void Finish(const std::vector<BodyPair>& touching);

 private:
  std::vector<world::Contact>& contacts_;
  double gap_;
};

}  // namespace gsv::dynamics
