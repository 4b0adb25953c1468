// Collects the contacts of rigid bodies over the substeps of a step as a list of world::Contact.
// Private to this folder: it includes Bullet.
#pragma once

#include <vector>

#include "gsv/dynamics/rigid/contact_finder.h"
#include "gsv/dynamics/shapes/contact_collector.h"

namespace gsv::dynamics {

// Collects the contacts of a step over its substeps.
class RigidContacts {
 public:
  // Starts a step.
  void Clear();
  // Adds the contacts of a substep, with their impulses.
  void Add(const ContactFinder& finder, const std::vector<Contact>& contacts);
  // Sets `contacts` to the contacts of the step. A pair of bodies has at most two: one contact by
  // which the second body carries the first (`supports`), and one other contact. Each contact has
  // the depth of its deepest point, the total impulse, and the points of the last substep with
  // contact.
  void Store(std::vector<world::Contact>& contacts);

 private:
  struct Found {
    world::Contact contact;     // the contact at one point in one substep
    geometry::Vector3 impulse;  // impulse on the second body, N s: normal force and friction
    int substep;                // number of the substep in its step, from 0
  };

  std::vector<Found> found_;        // contacts of all substeps so far
  std::vector<BodyPair> at_start_;  // pairs that touched when the step began
  int substep_ = 0;                 // number of substeps so far
};

}  // namespace gsv::dynamics
