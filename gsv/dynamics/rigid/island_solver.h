// The impulses and velocities of one island: bodies that act on each other, directly or through
// others. Private to this folder: it includes Bullet.
//
// Method   the velocities v and the impulses f solve M v = momenta + Jᵀ f. Each contact has
//          Coulomb's cone, each joint row its bounds (Alart and Curnier, "A mixed formulation for
//          frictional contact problems prone to Newton like solution methods", 1991). A semismooth
//          Newton method finds them: whether a contact is open, sticks or slips follows from the
//          iteration before, its impulses are linear in the velocities, and linear equations in the
//          velocities alone remain. Contacts begin as their velocities suggest. Most islands take
//          two to four iterations.
// Loads    impulses grow from zero by a small compliance, in proportion to the inverse mass, which
//          later iterations take back. So redundant contacts share the load as equal springs would.
// Heaps    islands of more than kMaxHeap velocities in which no body has joints are left to
//          ContactSweeps. Newton's method takes many iterations where such islands collide.
// Else     other islands of more than kMaxVelocities, and the few in which Newton's method does not
//          end, are left to ImpulseRows.
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

// A row on a body that gives a point the required speed along a direction, by a force that never
// pulls.
struct PushRow {
  int moving = 0;
  geometry::Vector3 point, normal;  // world
  double speed = 0, limit = 0;      // m/s, N s
  double impulse = 0;               // found by the solver
};

class IslandSolver {
 public:
  static constexpr int kMaxVelocities = 96, kMaxHeap = 48;

  void Clear();
  void AddBody(int moving) { bodies_.push_back(moving); }
  void AddContact(int contact) { contacts_.push_back(contact); }
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

  // Call it after Solve(). For each body that overlaps another, writes the velocity by which it
  // also moves in this substep to `shifts` (m/s, by moving body).
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
    double target = 0, softness = 0, lower = 0, upper = 0;
    double compliance = 0,
           stiffness = 0;  // stiffness for the iterations: of the proximal step, and of guesses
    double impulse = 0;
    bool is_active = false;
  };
  struct ContactRows {
    Row normal;  // its values are three rows
    int index = 0;
    double friction = 0;
    std::array<double, 2> target{}, softness{}, compliance{}, impulse{};
    double stiffness = 0;  // stiffness of both tangents
    enum class Mode : std::uint8_t { kOpen, kSticks, kSlips } mode = Mode::kOpen;
    std::array<double, 2> direction{};  // direction of friction, if the contact slips
    double turning = 0;                 // stiffness across the direction
    std::array<double, 3> velocity{};
  };

  void AddJointRows(std::span<const std::unique_ptr<MovingBody>> bodies);
  void AddPushRow(std::span<const std::unique_ptr<MovingBody>> bodies, const PushRow& push);
  void AddContactRows(const ContactFinder& finder,
                      std::span<const std::unique_ptr<MovingBody>> bodies, const Contact& contact,
                      int index, double substep);
  double AddSide(const MovingBody& body, const Collider& collider, const geometry::Vector3& point,
                 double sign, const Contact& contact);
  void SetTargets(const Contact& contact, bool has_tree, const std::array<double, 3>& known,
                  double substep, ContactRows& rows) const;
  std::array<double, 3> VelocityAt(const ContactRows& rows, const std::vector<double>& v) const;
  double VelocityOf(const Row& row, const std::vector<double>& v) const;
  int BodyAt(int column) const;

  bool SolveByNewton(std::span<const std::unique_ptr<MovingBody>> bodies);
  void Guess();
  void WriteEquations(std::span<const std::unique_ptr<MovingBody>> bodies);
  void AddRow(const Row& row);
  void AddContactEquations(const ContactRows& rows);
  void TakeImpulses();
  double ChooseModes();
  double ChooseMode(ContactRows& rows) const;
  static double CouplingOf(const ContactRows& rows);

  bool CanSweep(std::span<const std::unique_ptr<MovingBody>> bodies) const;
  void SolveBySweeps(const ContactFinder& finder,
                     std::span<const std::unique_ptr<MovingBody>> bodies,
                     std::vector<Contact>& contacts, double substep);
  void StoreVelocities(std::span<const std::unique_ptr<MovingBody>> bodies,
                       std::span<const int> starts, std::span<double> velocities) const;

  void ApplyImpulses(std::span<const std::unique_ptr<MovingBody>> bodies);
  void SolveByRows(std::span<const std::unique_ptr<MovingBody>> bodies);
  void AddRowTo(const Row& row, const double* values, const ImpulseRows::Limits& limits,
                std::span<const std::unique_ptr<MovingBody>> bodies);

  std::vector<int> bodies_, contacts_, pushes_;
  int size_ = 0;
  std::vector<int> first_;     // index of each body's first velocity
  std::vector<int> first_of_;  // the same, by the index of the moving body
  std::vector<Row> rows_;      // rows of joints, then rows of pushes
  std::size_t joint_rows_ = 0;
  std::vector<ContactRows> contact_rows_;
  std::vector<int> columns_;
  std::vector<double> values_;
  std::vector<double> start_, free_, momenta_, velocities_;
  std::vector<double> matrix_, unknown_;
  std::vector<double> side_values_[3];
  std::vector<geometry::Vector3> motions_;
  ImpulseRows impulse_rows_;
  ContactSweeps sweeps_;
  OverlapRemoval overlaps_;
  bool is_swept_ = false;
  struct Pending {
    ContactSweeps::Side first, second;
    std::array<geometry::Vector3, 3> axes;
    std::array<double, 3> targets;
    double friction;
    std::array<double, 2> softness;
    std::array<double, 3> impulse;
  };
  std::vector<Pending> pending_;  // contacts, before they are added to sweeps_
  std::vector<int> place_of_;     // in bodies_, by the index of the moving body
  // for each body, the index at which its velocities begin in the rows
  std::vector<int> columns_of_rows_;
  std::vector<double> jacobian_[2], response_[2];
};

}  // namespace gsv::dynamics
