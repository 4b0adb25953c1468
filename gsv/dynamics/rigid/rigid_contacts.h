// What touches what in a Bullet world: surfaces in, contacts out. Private to this folder.
//
// Surfaces  two that touch have the smaller friction of the two and the product of their
//           restitutions, as in DART, which Gazebo uses. Where one of them has two frictions, they
//           act along its direction and across; where both have, that of the more slippery one
//           counts. A base that its drive holds (HoldBase) glides on what carries it: its traction
//           is the drive's.
#pragma once

#include <deque>
#include <vector>

#include "gsv/dynamics/rigid/impulse_solver.h"
#include "gsv/dynamics/rigid/rigid_scene.h"
#include "gsv/dynamics/shapes/contact_collector.h"

namespace gsv::dynamics {

// What a collision object stands for; its user pointer points to one.
struct Owner {
  const Solid* solid = nullptr;
  std::deque<FrictionAxes>* axes = nullptr;  // where those of its contacts are kept
  bool moves_by_forces = false;
  bool is_held = false;  // by a drive, at its base
  bool touches = false;  // something, in the last substep
};

// To be called before the first collision is looked for: has Bullet ask for surfaces and filters.
void InstallSurfaces();

class RigidContacts {
 public:
  // Starts a step.
  void Clear();
  // Reads what touches after a substep: marks owners, and adds the contacts of what moves by
  // forces.
  void Read(btDispatcher& dispatcher);
  // `contacts` becomes those of the step: for each pair of bodies one, and one that supports. Each
  // has the deepest of its points, the impulse of all, and the points of the last substep in which
  // there were any.
  void Store(std::vector<world::Contact>& contacts);

 private:
  struct Found {
    world::Contact contact;  // of one point, in one substep
    int substep;
  };

  void Add(const Owner& first, const Owner& second, const btPersistentManifold& manifold);

  std::vector<Found> found_;
  std::vector<BodyPair> at_start_;  // who touched when the step began
  int substep_ = 0;
};

}  // namespace gsv::dynamics
