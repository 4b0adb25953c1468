// Velocities that separate bodies which overlap, in one substep. They move the bodies and do not
// become part of their motion, so that no kinetic energy arises (split impulses: Catto, "Modeling
// and Solving Constraints", GDC 2009).
//
// Method   along the normal of each pair, the bodies separate by kShare of their overlap in a
//          substep. Pairs that do not overlap may approach by their gap. The velocities w minimise
//          the sum of m |w|². They are found by projected Gauss-Seidel, forwards and backwards in
//          turn. Bodies are only shifted, not rotated. So contacts of a pair with the same normal
//          share a row, for the deepest point.
// Speed    all velocities are scaled so that none exceeds kMaxSpeed. At this speed, two bodies
//          approach within a substep by less than the margin of contacts, so that no body is pushed
//          through another.
// Threads  one thread at a time for each object.
// Determinism  Solve() is a function of the added bodies and contacts, in their order.
#pragma once

#include <vector>

#include "gsv/geometry/pose.h"

namespace gsv::dynamics {

// Computes velocities that separate overlapping bodies.
class OverlapRemoval {
 public:
  static constexpr double kShare = 0.2;     // fraction of an overlap that one substep removes
  static constexpr double kMaxSpeed = 0.5;  // maximum of the computed velocities, m/s

  // Removes all bodies and contacts.
  void Clear();
  // Adds a body, and returns its index.
  int AddBody(double inverse_mass);
  // Adds a contact point of two bodies; -1 is a body that does not move. `normal` has unit length
  // and points from the second to the first. `gap` (m) is their distance at the end of the substep,
  // negative if they overlap.
  void AddContact(int first, int second, const geometry::Vector3& normal, double gap);
  // Computes the velocities for a substep (s). Returns false if no pair has to part faster than
  // 0.1 mm/s; then there are no velocities.
  bool Solve(double substep);
  // Returns the velocity of a body, in m/s in the world's frame.
  const geometry::Vector3& velocity(int body) const {
    return bodies_[static_cast<std::size_t>(body)].velocity;
  }

 private:
  // A body that was added.
  struct Body {
    double inverse_mass = 0;     // 1/kg
    geometry::Vector3 velocity;  // see velocity(), m/s
  };
  // A contact: the condition that its two bodies separate fast enough.
  struct Row {
    // The arguments of AddContact(): bodies, normal in the world, and gap (m).
    int first, second;
    geometry::Vector3 normal;
    double gap;
    // Wanted velocity along the normal (m/s), effective mass (kg), and impulse so far (N s).
    double target = 0, mass = 0, impulse = 0;
  };

  Body& At(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  // Solves one contact. Returns the change of velocity, m/s.
  double SolveRow(Row& row);
  // Scales all velocities so that none exceeds kMaxSpeed.
  void Limit();

  std::vector<Body> bodies_;
  std::vector<Row> rows_;  // consecutive contacts of a pair with one normal share a row
};

}  // namespace gsv::dynamics
