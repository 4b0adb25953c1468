// Contacts in a Bullet world: passes surfaces to Bullet, and reads contacts. Private to this folder.
//
// Surfaces  A contact has the smaller friction of the two surfaces and the product of their
//           restitutions, as in DART, which Gazebo uses. If one surface has two frictions, they act
//           along its direction and across it; if both have, those of the more slippery one count.
//           A wheel slips, and so does what lies on a surface with a slip, see
//           motion/wheel_slip.h. A base that its drive controls directly (HoldBase) has no friction with the bodies that
//           carry it: its traction is the drive's.
#pragma once

#include <deque>
#include <vector>

#include "gsv/dynamics/rigid/impulse_solver.h"
#include "gsv/dynamics/rigid/rigid_scene.h"
#include "gsv/dynamics/shapes/contact_collector.h"

namespace gsv::dynamics {

// The body that a collision object belongs to. The object's user pointer points to an Owner.
struct Owner {
  const Solid* solid = nullptr;
  std::deque<FrictionAxes>* axes = nullptr;  // storage for the axes of its contacts
  bool is_rigid = false;
  bool is_held = false;  // its drive controls the base directly
  bool touches = false;  // in contact in the last substep
  double rate = 0;       // rad/s, without sign: of a wheel, at the start of the substep
};

// Makes Bullet ask for surfaces and filters. Must be called before the first collision detection.
void InstallSurfaces();

class RigidContacts {
 public:
  // Starts a step.
  void Clear();
  // Reads the contacts after a substep: marks owners, and adds the contacts of rigid bodies.
  void Read(btDispatcher& dispatcher);
  // `contacts` becomes those of the step: for each pair of bodies one, and one that supports. Each
  // has the deepest of its points, the impulse of all, and the points of the last substep in which
  // there were any.
  void Store(std::vector<world::Contact>& contacts);

 private:
  struct Found {
    world::Contact contact;     // the contact at one point, in one substep
    geometry::Vector3 impulse;  // N s on the second body: normal force and friction
    int substep;
  };

  void Add(const Owner& first, const Owner& second, const btPersistentManifold& manifold);

  std::vector<Found> found_;
  std::vector<BodyPair> at_start_;  // pairs that touched when the step began
  int substep_ = 0;
};

}  // namespace gsv::dynamics
