// A point at which two solids touch, with the inputs and results of the solver.
#pragma once

#include <array>

#include "gsv/dynamics/rigid/placed_piece.h"

namespace gsv::dynamics {

// A point at which two solids touch, with the inputs and results of the solver.
struct Contact {
  int first = 0, second = 0;             // solids: indices for ContactFinder::collider()
  TouchPoint point;                      // where the solids touch, with the normal and the distance
  double friction = 0, restitution = 0;  // coefficients, see SetSurfaces()
  // Friction acts along these two axes, at right angles to the normal. If a surface has two
  // friction coefficients, the axis with the lower coefficient is shorter than 1.
  std::array<geometry::Vector3, 2> axes;
  // m/(s N): the velocity at which the solids slide along each axis, divided by the friction force
  // of all their contact points together.
  std::array<double, 2> slip{};
  std::array<double, 2> softness{};  // sliding velocity per impulse at this point: (m/s) / (N s)
  std::array<double, 3> impulse{};   // impulse along the normal and the axes, N s

  // The contact point on the first solid, in the world.
  geometry::Vector3 on_first() const { return point.on_second + point.distance * point.normal; }
};

// A wheel that slips at a contact.
struct SlippingContact {
  geometry::Vector3 forwards;    // rolling direction in the world, of any length
  double along = 0, across = 0;  // slip along the rolling direction and the axle, m/(s N)
};

// Sets the friction, slip and restitution of two surfaces in contact. The restitution is the
// product of both restitutions. A friction coefficient is the smaller one of both surfaces, as in
// DART, which Gazebo uses. A surface with two friction coefficients, or with slip, has a direction:
// the axes are then along and across this direction. If both surfaces have a direction, the more
// slippery surface decides. If no surface has a direction, the axes are along and across the
// rolling direction of `wheel`, which is null if no wheel slips. The slips of both surfaces and of
// the wheel are added.
void SetSurfaces(const PlacedPiece& first, const PlacedPiece& second, const SlippingContact* wheel,
                 Contact& contact);

// m: penetration of resting bodies, so that they stay in contact.
inline constexpr double kRestingDepth = 1e-5;

// Returns the velocity that the first body must have relative to the second at the end of a
// substep. The value along the normal is a minimum. Friction reaches the values along the axes if
// it is strong enough. `meeting` is the relative velocity along the normal when the bodies come
// into contact. `free` are the velocities at the end of the substep without impulses.
std::array<double, 3> TargetsOf(const Contact& contact, bool has_tree, double meeting,
                                const std::array<double, 3>& free, double substep);

}  // namespace gsv::dynamics
