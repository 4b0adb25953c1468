// The impulses at the contacts of heaps, from which ContactSweeps starts in the next substep. They
// are a part of the state.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/rigid/contact_finder.h"
#include "gsv/dynamics/shapes/contact_collector.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

class KeptImpulses final : public world::EngineState {
 public:
  struct Entry {
    BodyPair bodies;          // in the layout, as the contact has them
    geometry::Vector3 point;  // in the frame of the first's part
    geometry::Vector3 force;  // N: on the first, in the world
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  void AddToHash(base::Hash& hash) const override;

  // Adds the impulse of a contact over a substep.
  void Add(const ContactFinder& finder, const Contact& contact, double substep);
  // Sorts what was added: before StartFrom().
  void Finish();
  // Sets the impulses of contacts that are within a centimetre of one of these.
  void StartFrom(const ContactFinder& finder, std::vector<Contact>& contacts, double substep) const;

  void Clear() { entries_.clear(); }
  bool is_empty() const { return entries_.empty(); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace gsv::dynamics
