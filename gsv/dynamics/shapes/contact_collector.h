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
  // Fills `contacts`, which it clears; what is further apart than `gap` is no contact (below 0:
  // what overlaps by less than -gap).
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
