// Stores the impulses at the contacts of heaps, which are large islands of bodies without joints.
// ContactSweeps starts the next substep from these impulses. They are a part of the world's state.
#pragma once

#include <memory>
#include <vector>

#include "gsv/dynamics/rigid/contact_finder.h"
#include "gsv/dynamics/shapes/contact_collector.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// The impulses of a substep, from which the next substep starts.
class KeptImpulses final : public world::EngineState {
 public:
  // The impulse at one contact point, stored as the mean force during the substep.
  struct Entry {
    BodyPair bodies;          // indices in the layout: of the contact's first and second body
    geometry::Vector3 point;  // contact point, in the frame of the first body's part
    geometry::Vector3 force;  // force on the first body, N, in the world
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  void AddToHash(base::Hash& hash) const override;

  // Adds the impulse of a contact over a substep.
  void Add(const ContactFinder& finder, const Contact& contact, double substep);
  // Sorts the added impulses. Call it before StartFrom().
  void Finish();
  // Sets the impulses of those contacts that are within a centimetre of a stored contact.
  void StartFrom(const ContactFinder& finder, std::vector<Contact>& contacts, double substep) const;

  // Removes all impulses.
  void Clear() { entries_.clear(); }
  bool is_empty() const { return entries_.empty(); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace gsv::dynamics
