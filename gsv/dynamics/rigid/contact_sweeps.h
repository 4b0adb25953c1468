// The contacts of a large island of bodies without joints, by projected Gauss-Seidel, contact by
// contact.
//
// Order    from the contacts with what does not move outwards, then back, in turn: a heap is carried
//          from below, so that its lowest contacts must carry the sum of all above.
// Start    from given impulses, as those of the step before.
// Cone     friction of a contact is at most its coefficient times the normal impulse, and is opposite
//          to the slip where it is that large.
// Threads  one thread at a time for each object.
// Determinism  Solve() is a function of the added bodies and contacts, in their order.
#pragma once

#include <array>
#include <vector>

#include "gsv/dynamics/rigid/matrix3.h"

namespace gsv::dynamics {

class ContactSweeps {
 public:
  struct Body {
    geometry::Vector3 velocity, angular_velocity;
    double inverse_mass = 0;
    Matrix3 inverse_inertia;
  };
  struct Side {
    int body = -1;          // from AddBody(); -1: nothing moves it
    geometry::Vector3 arm;  // from the body's centre of mass
  };

  void Clear();
  int AddBody(const Body& body);
  // `axes` are the normal, from the second side to the first, and two axes of friction. Along each,
  // the first side is to move at `targets` relative to the second. `impulse`, along the axes, is
  // where the solution starts; it has not been applied yet. Friction holds the targets but for
  // `softness` times its impulse.
  void AddContact(const Side& first, const Side& second,
                  const std::array<geometry::Vector3, 3>& axes,
                  const std::array<double, 3>& targets, double friction,
                  const std::array<double, 2>& softness, const std::array<double, 3>& impulse);

  // Until no velocity at a contact changes by more than `tolerance` (m/s) in a sweep. Returns the
  // number of sweeps.
  int Solve(int max_sweeps, double tolerance);

  const Body& body(int index) const { return bodies_[static_cast<std::size_t>(index)]; }
  const std::array<double, 3>& impulse(int contact) const {
    return contacts_[static_cast<std::size_t>(contact)].impulse;
  }

 private:
  struct Contact {
    int first, second;
    geometry::Vector3 arm_first, arm_second;
    std::array<geometry::Vector3, 3> axes;
    std::array<geometry::Vector3, 3> turn_first, turn_second;  // by a unit impulse along each axis
    double inverse_normal;                                     // of J M⁻¹ Jᵀ along the normal
    double a, b, c;  // J M⁻¹ Jᵀ of friction, with its softness: [[a, c], [c, b]]
    double inverse_determinant, inverse_most;
    std::array<double, 3> targets;
    double friction;
    std::array<double, 2> softness;
    std::array<double, 3> impulse;
  };

  geometry::Vector3 VelocityAt(const Contact& contact) const;
  void Apply(const Contact& contact, std::size_t axis, double impulse);
  double SolveContact(Contact& contact);
  void Order();

  std::vector<Body> bodies_;
  std::vector<Contact> contacts_;
  std::vector<int> order_, levels_, queue_, first_of_body_, contacts_of_body_;
};

}  // namespace gsv::dynamics
