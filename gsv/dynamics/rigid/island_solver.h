// Computes the impulses and velocities of one island: bodies that act on each other, directly or
// through other bodies. Private to this folder: it includes Bullet.
//
// Method   the velocities v and the impulses f solve M v = momenta + Jᵀ f. Contacts are limited by
//          Coulomb's cone, and joint rows by their bounds (Alart and Curnier, "A mixed formulation
//          for frictional contact problems prone to Newton like solution methods", 1991). A
//          semismooth Newton method finds the solution. The previous iteration determines whether a
//          contact is open, sticks or slips. Then its impulses are linear in the velocities, and
//          linear equations for the velocities remain. The first guess follows from the contacts'
//          velocities. Most islands take two to four iterations.
// Loads    each iteration gives impulses a small compliance, in proportion to the inverse mass; the
//          following iterations remove its effect. So redundant contacts share the load as equal
//          springs would.
// Heaps    ContactSweeps solves islands of more than kMaxHeap velocities in which no body has
//          joints or is pushed, because Newton's method takes many iterations where such islands
//          collide.
// Others   ImpulseRows solves all other islands of more than kMaxVelocities, and the few for which
//          Newton's method does not converge.
// Overlaps of bodies without joints: see OverlapRemoval.
// Threads  one thread at a time for each object.
// Determinism  Solve() is a function of its bodies and contacts, in their order.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gsv/dynamics/rigid/contact_finder.h"
#include "gsv/dynamics/rigid/contact_sweeps.h"
#include "gsv/dynamics/rigid/impulse_rows.h"
#include "gsv/dynamics/rigid/overlap_removal.h"

namespace gsv::dynamics {

// A row that gives a point of a body the required speed along a direction. Its force never pulls.
struct PushRow {
  int moving = 0;                   // index of the moving body
  geometry::Vector3 point, normal;  // world
  double speed = 0, limit = 0;      // m/s, N s
  double impulse = 0;               // result of the solver, N s
};

// Computes the impulses and velocities of one island of bodies that act on each other.
class IslandSolver {
 public:
  // Numbers of velocities, see "Heaps" and "Others" above.
  static constexpr int kMaxVelocities = 96, kMaxHeap = 48;

  // Removes all bodies, contacts and pushes.
  void Clear();
  // Adds a body of the island, by its index in `bodies` of Solve().
  void AddBody(int moving) { bodies_.push_back(moving); }
  // Adds a contact, by its index in `contacts` of Solve().
  void AddContact(int contact) { contacts_.push_back(contact); }
  // Adds a push, by its index in `pushes` of Solve().
  void AddPush(int push) { pushes_.push_back(push); }
  const std::vector<int>& contacts() const { return contacts_; }
  // Whether Solve() started from the impulses in its contacts.
  bool starts_from_impulses() const { return is_swept_; }

  // Solves for a substep. Sets the impulses of the island's contacts and pushes. `starts` has the
  // index in `velocities` at which each moving body's velocities begin. The results are written
  // there.
  void Solve(const ContactFinder& finder, std::span<const std::unique_ptr<MovingBody>> bodies,
             std::vector<Contact>& contacts, std::vector<PushRow>& pushes,
             std::span<const int> starts, std::span<double> velocities, double substep);

  // Writes to `shifts` (by moving body) the velocities that push overlapping bodies apart, m/s. A
  // body moves with this additional velocity in this substep only. Call it after Solve().
  void RemoveOverlaps(const ContactFinder& finder,
                      std::span<const std::unique_ptr<MovingBody>> bodies,
                      const std::vector<Contact>& contacts, double substep,
                      std::span<geometry::Vector3> shifts);

 private:
  // A joint row, a push or a contact, which has three rows.
  struct Row {
    int begin = 0, count = 0;  // range of its velocities in columns_
    // start of its values in values_: one row after the other, with `count` values each
    int values = 0;
    // `target` is the required velocity (m/s; rad/s for a rotation). The velocity may differ from
    // it by `softness` times the impulse. The impulse (N s; N m s for a rotation) is between
    // `lower` and `upper`.
    double target = 0, softness = 0, lower = 0, upper = 0;
    // Used by the iterations: the compliance of an impulse, and the stiffness that converts a
    // velocity error to a guess of the impulse.
    double compliance = 0, stiffness = 0;
    double impulse = 0;      // the present solution, N s or N m s
    bool is_active = false;  // whether the row is in the linear equations
  };
  // The rows of a contact: the normal, and two tangents.
  struct ContactRows {
    Row normal;           // its values are the values of three rows: normal, then both tangents
    int index = 0;        // index in `contacts` of Solve()
    double friction = 0;  // coefficient of friction
    // Values along both tangents, as in Row. The targets (m/s) are velocities of the first body
    // relative to the second. Bodies with a prescribed motion have no row, so their part of the
    // relative velocity is already subtracted.
    std::array<double, 2> target{}, softness{}, compliance{}, impulse{};
    double stiffness = 0;  // stiffness of both tangents, see Row
    enum class Mode : std::uint8_t { kOpen, kSticks, kSlips } mode = Mode::kOpen;
    std::array<double, 2> direction{};  // direction of friction, if the contact slips
    double turning = 0;                 // stiffness across the direction
    std::array<double, 3> velocity{};   // along the normal and the tangents, m/s; see VelocityAt()
  };

  // Adds the rows of all joints.
  void AddJointRows(std::span<const std::unique_ptr<MovingBody>> bodies);
  // Adds the row of a push.
  void AddPushRow(std::span<const std::unique_ptr<MovingBody>> bodies, const PushRow& push);
  // Adds the three rows of a contact.
  void AddContactRows(const ContactFinder& finder,
                      std::span<const std::unique_ptr<MovingBody>> bodies, const Contact& contact,
                      int index, double substep);
  // Appends the velocities of one body of a contact to columns_, and their values for the contact's
  // three rows to side_values_. Returns the body's part of J M⁻¹ Jᵀ along the normal.
  double AddSide(const MovingBody& body, const Collider& collider, const geometry::Vector3& point,
                 double sign, const Contact& contact);
  // Sets the target velocities of a contact. `known` is the velocity due to bodies with a
  // prescribed motion.
  void SetTargets(const Contact& contact, bool has_tree, const std::array<double, 3>& known,
                  double substep, ContactRows& rows) const;
  // Returns the relative velocity of the bodies of a contact, along its normal and its tangents.
  // `v` are the velocities of the island.
  std::array<double, 3> VelocityAt(const ContactRows& rows, const std::vector<double>& v) const;
  // Returns the velocity of a row, for the velocities `v` of the island.
  double VelocityOf(const Row& row, const std::vector<double>& v) const;
  // Returns the index in bodies_ of the body that has this velocity.
  int BodyAt(int column) const;

  // Returns false if Newton's method does not converge.
  bool SolveByNewton(std::span<const std::unique_ptr<MovingBody>> bodies);
  // Chooses the modes of all rows and contacts from the velocities without impulses.
  void Guess();
  // Writes the linear equations for the velocities.
  void WriteEquations(std::span<const std::unique_ptr<MovingBody>> bodies);
  // Adds a row to the linear equations.
  void AddRow(const Row& row);
  // Adds the rows of a contact to the linear equations.
  void AddContactEquations(const ContactRows& rows);
  // Computes the impulses that belong to the new velocities.
  void TakeImpulses();
  // Updates which rows are active, and whether contacts are open, stick or slip. Returns the
  // largest error, m/s.
  double ChooseModes();
  // Chooses whether a contact is open, sticks or slips. Returns its error, m/s.
  double ChooseMode(ContactRows& rows) const;
  // Returns the velocity across the direction of slip which the contact's softness permits if the
  // normal impulse is 1.
  static double CouplingOf(const ContactRows& rows);

  // Whether no body of the island has joints or is pushed.
  bool CanSweep(std::span<const std::unique_ptr<MovingBody>> bodies) const;
  // Solves the island with ContactSweeps.
  void SolveBySweeps(const ContactFinder& finder,
                     std::span<const std::unique_ptr<MovingBody>> bodies,
                     std::vector<Contact>& contacts, double substep);
  // Writes the island's velocities to `velocities`.
  void StoreVelocities(std::span<const std::unique_ptr<MovingBody>> bodies,
                       std::span<const int> starts, std::span<double> velocities) const;

  // Computes the velocities from the impulses.
  void ApplyImpulses(std::span<const std::unique_ptr<MovingBody>> bodies);
  // Solves the island with ImpulseRows.
  void SolveByRows(std::span<const std::unique_ptr<MovingBody>> bodies);
  // Adds a row, whose jacobian is `values`, to impulse_rows_.
  void AddRowTo(const Row& row, const double* values, const ImpulseRows::Limits& limits,
                std::span<const std::unique_ptr<MovingBody>> bodies);

  // Indices in the lists that are passed to Solve().
  std::vector<int> bodies_, contacts_, pushes_;
  int size_ = 0;                // number of velocities of the island
  std::vector<int> first_;      // index of each body's first velocity
  std::vector<int> first_of_;   // index of the first velocity, by the index of the moving body
  std::vector<Row> rows_;       // rows of joints, then rows of pushes
  std::size_t joint_rows_ = 0;  // number of rows of joints, at the start of rows_
  std::vector<ContactRows> contact_rows_;
  std::vector<int> columns_;    // velocities on which the rows act, see Row::begin
  std::vector<double> values_;  // jacobians of the rows, see Row::values
  // Velocities of the island: before the substep, after the substep without impulses, and the
  // solution. `momenta_` are the mass matrix times free_.
  std::vector<double> start_, free_, momenta_, velocities_;
  std::vector<double> matrix_, unknown_;  // the linear equations for the velocities
  std::vector<double> side_values_[3];  // values of a contact's three rows, before they are stored
  std::vector<geometry::Vector3> motions_;  // memory for LinkTree::PointMotions()
  ImpulseRows impulse_rows_;
  ContactSweeps sweeps_;
  OverlapRemoval overlaps_;
  bool is_swept_ = false;  // whether ContactSweeps solves the island
  // The arguments of ContactSweeps::AddContact() for a contact.
  struct Pending {
    ContactSweeps::Side first, second;
    std::array<geometry::Vector3, 3> axes;
    std::array<double, 3> targets;
    double friction;
    std::array<double, 2> softness;
    std::array<double, 3> impulse;
  };
  std::vector<Pending> pending_;  // contacts, before they are added to sweeps_
  // for each moving body, indexed as in the argument of Solve(): its index in bodies_
  std::vector<int> place_of_;
  // for each body, the index at which its velocities begin in the rows
  std::vector<int> columns_of_rows_;
  // A row of impulse_rows_ acts on at most two bodies, its sides. For each side, the row's jacobian
  // J for the body's velocities, and M⁻¹ Jᵀ.
  std::vector<double> jacobian_[2], response_[2];
};

}  // namespace gsv::dynamics
