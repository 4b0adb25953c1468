// Solves the contacts of a large island of bodies without joints by projected Gauss-Seidel, one
// contact after the other.
//
// Batches  of four contacts that have no body in common are solved at once, in the four values of a
//          vector.
// Order    level by level, from contacts with fixed bodies upwards, and in every second sweep
//          downwards. The lowest contacts of a heap must carry the weight of all bodies above.
// Start    from the impulses that AddContact() is given, such as those of the previous step.
// Cone     the friction of a contact is at most its coefficient times the normal impulse. Friction
//          that reaches this limit is opposite to the slip.
// Threads  one thread at a time for each object.
// Determinism  Solve() is a function of the added bodies and contacts, in their order.
#pragma once

#include <array>
#include <vector>

#include "gsv/dynamics/rigid/four_doubles.h"
#include "gsv/dynamics/rigid/matrix3.h"

namespace gsv::dynamics {

// Solves the contacts of a large island of bodies without joints.
class ContactSweeps {
 public:
  // A body. All vectors are in the world's frame. The velocities change with each impulse.
  struct Body {
    geometry::Vector3 velocity, angular_velocity;  // of its centre of mass, m/s; rad/s
    double inverse_mass = 0;                       // 1/kg
    Matrix3 inverse_inertia;                       // about its centre of mass, 1/(kg m²)
  };
  // One of the two bodies at a contact.
  struct Side {
    int body = -1;          // from AddBody(); -1 for a fixed body
    geometry::Vector3 arm;  // vector from the body's centre of mass to the contact
  };

  // Removes all bodies and contacts.
  void Clear();
  // Adds a body, and returns its index.
  int AddBody(const Body& body);
  // Adds a contact. `axes` are the normal, from the second side to the first, and two axes of
  // friction. Along each axis, the first side must move at `targets` relative to the second side.
  // Along an axis of friction, the velocity may differ from its target by `softness` times the
  // impulse. `impulse`, along the axes, is a first guess of the solution, which this function
  // applies to both bodies.
  void AddContact(const Side& first, const Side& second,
                  const std::array<geometry::Vector3, 3>& axes,
                  const std::array<double, 3>& targets, double friction,
                  const std::array<double, 2>& softness, const std::array<double, 3>& impulse);

  // Iterates until no velocity at a contact changes by more than `tolerance` (m/s) in a sweep.
  // Returns the number of sweeps.
  int Solve(int max_sweeps, double tolerance);

  const Body& body(int index) const { return bodies_[static_cast<std::size_t>(index)]; }
  // The impulse of a contact along its normal and its two friction axes, N s.
  const std::array<double, 3>& impulse(int contact) const {
    return contacts_[static_cast<std::size_t>(contact)].impulse;
  }

 private:
  // A contact, with the values that AddContact() computes once.
  struct Contact {
    int first, second;  // bodies; -1 for a fixed body
    // See Side::arm and the arguments of AddContact(). All vectors are in the world's frame.
    geometry::Vector3 arm_first, arm_second;
    std::array<geometry::Vector3, 3> axes;
    // Changes of the two bodies' angular velocities by a unit impulse along each axis.
    std::array<geometry::Vector3, 3> turn_first, turn_second;
    // The effect of unit impulses on the velocities at the contact, J M⁻¹ Jᵀ. `normal` is the
    // effect of a normal impulse along the normal. [[a, c], [c, b]] is the effect of friction,
    // including its softness, and `max` is the largest eigenvalue of this matrix. `coupling` is the
    // effect of a normal impulse along each friction axis.
    double normal, a, b, c, max;
    std::array<double, 2> coupling;
    std::array<double, 3> targets;   // along the axes, m/s
    double friction;                 // coefficient of friction
    std::array<double, 2> softness;  // along the axes of friction, (m/s) / (N s)
    std::array<double, 3> impulse;   // the present solution, N s
  };
  // Four contacts, one in each value of a vector. The members are those of Contact, and the
  // reciprocals of `normal`, of `max`, and of the determinant of [[a, c], [c, b]]. Unused values
  // refer to bodies that no impulse moves.
  struct alignas(sizeof(FourDoubles)) Batch {
    using Vectors = FourDoubles[3];
    Vectors arm_first, arm_second;
    Vectors axes[3], turn_first[3], turn_second[3];
    FourDoubles normal, inverse_normal, a, b, c, inverse_determinant, max, inverse_max;
    FourDoubles coupling[2];
    Vectors targets;
    FourDoubles friction;
    FourDoubles softness[2];
    Vectors impulse;
    std::array<int, kFour> contacts, first, second;  // -1: none
  };

  // Applies an impulse along an axis to both bodies of a contact.
  void Apply(const Contact& contact, std::size_t axis, double impulse);
  // Orders the contacts by their level, see LevelOf().
  void Order();
  // Returns -1 for a contact with a fixed body, else the larger level of its two bodies. The level
  // of a body is the smallest number of bodies between it and a fixed body.
  int LevelOf(int contact) const;
  // Puts the contacts into batches of four.
  void MakeBatches();
  // Writes a contact into one of the four values of a batch.
  void Fill(Batch& batch, std::size_t value, const Contact& contact) const;
  // Whether the batch has space, and no contact with one of these bodies.
  static bool CanTake(const Batch& batch, int first, int second);
  // Solves the contacts of a batch once. Returns the largest change of a velocity, m/s.
  static double Solve(Batch& batch, double* motions);
  // Solves all batches once. Returns the largest change of a velocity, m/s.
  static double Sweep(std::vector<Batch>& batches, bool is_forwards, double* motions);

  std::vector<Body> bodies_;
  std::vector<Contact> contacts_;
  std::vector<Batch> batches_;  // the contacts, in the order in which Solve() uses them
  std::vector<int> open_;       // batches with space for more contacts
  // For each body, and for one fixed body: velocity, inverse mass, angular velocity, 0.
  std::vector<double> motions_;
  // The contacts ordered by level, and the level of each body. The other members are memory for
  // Order(): bodies whose neighbours are visited next, and the contacts of each body.
  std::vector<int> order_, levels_, queue_, first_of_body_, contacts_of_body_;
};

}  // namespace gsv::dynamics
