// Finds the impulses that satisfy the velocity constraints of a substep. The constraints are given
// as numbers, without shapes or joints.
//
// Row       J v + softness x = target. Here v is the change of velocities of all bodies, one after
//           the other. x is the row's impulse, between a lower and an upper bound. A row acts on at
//           most two bodies.
// Cone      two friction rows of a contact. The length of their impulse is at most the friction
//           coefficient times the impulse of the normal row (Coulomb). At this limit, the impulse
//           is opposite to the slip, for any axes of the two rows.
// Method    projected Gauss-Seidel, row by row and cone by cone (each cone is solved exactly),
//           which finds the rows that are within their bounds. For at most kMaxDirect of these
//           rows, linear equations are solved after some iterations: Silcowitz, Niebur, Erleben,
//           "Projected Gauss-Seidel subspace minimization method for interactive rigid body
//           dynamics" (GRAPP 2010). These equations include how the friction rotates with the slip
//           (a semismooth Newton step). Larger problems are accelerated as a nonsmooth nonlinear
//           conjugate gradient: Silcowitz-Hansen and others, The Visual Computer 26 (2010).
//           Gauss-Seidel alone would take thousands of iterations for mass ratios of 1000 to 1 and
//           for long chains of joints.
// Start     from zero impulses. The first guess is that a body which moves along a surface slips,
//           and that all other contacts stick. Linear equations give the impulses of this guess.
// Loads     redundant rows, as of a base on two wheels and two casters, share the load as equal
//           springs would. This applies to at most kMaxDirect rows.
// Threads   one thread at a time.
// Determinism  Solve() is a function of the added rows and bodies, in their order.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "gsv/dynamics/rigid/four_doubles.h"

namespace gsv::dynamics {

// Solves velocity constraints (rows) for the impulses that satisfy them.
class ImpulseRows {
 public:
  // The effect of a row on one body. The spans have equal sizes, with one value per degree of
  // freedom.
  struct Side {
    int first = 0;                     // index of the body's velocities, from AddBody()
    std::span<const double> jacobian;  // empty if the side has no body or a fixed body
    std::span<const double> response;  // change of the body's velocities by a unit impulse
  };
  // The target velocity of a row, and the bounds of its impulse.
  struct Limits {
    double target = 0;            // m/s or rad/s
    double softness = 0;          // (m/s) / (N s), or in the units of the row
    double lower = 0, upper = 0;  // bounds of the impulse
  };

  // Removes all.
  void Clear();

  // Adds a body whose velocities earlier impulses have already changed by `velocities`. Returns the
  // index of the body's first value.
  int AddBody(std::span<const double> velocities);
  // The velocities of a body after all impulses so far. `first` is the result of AddBody().
  std::span<const double> velocities(int first, int count) const;

  // Adds a row and returns its index. `impulse` is already applied: its effect is part of the
  // velocities.
  int AddRow(const Side& a, const Side& b, const Limits& limits, double impulse);
  // Multiplies the row's target by `share`. Call it only before AddCone().
  void ScaleTarget(int row, double share) { At(row).target *= share; }
  // Returns the impulse of a row. A row that no impulse can move (J M⁻¹ Jᵀ = 0) keeps the impulse
  // that AddRow() has set.
  double impulse(int row) const { return rows_[static_cast<std::size_t>(row)].impulse; }

  // Two axes. Each has the weights of two rows: the row along an axis is the weighted sum of both.
  using Axes = std::array<std::array<double, 2>, 2>;
  // Makes a friction cone of `first_row` and the row after it, along the `axes`. Along each axis,
  // the velocity may differ from its target by the softness times the impulse. Returns the index of
  // the cone. Read the impulses with ConeImpulse(), because AddCone() changes both rows.
  int AddCone(int normal_row, int first_row, double friction, const Axes& axes,
              const std::array<double, 2>& softness = {});

  static constexpr int kMaxDirect = 150;  // maximum number of rows in the linear equations

  // Iterates until no row's velocity changes by more than the tolerance. Returns the number of
  // iterations.
  int Solve(int max_iterations, double tolerance);

  // The impulses of a friction cone, along the axes that were passed to AddCone(). These axes must
  // be orthonormal.
  std::array<double, 2> ConeImpulse(int cone) const;

 private:
  // The part of a row that acts on one body. `first`, `count` and `start` are multiples of four.
  // Elements beyond the body's degrees of freedom are zero.
  struct Block {
    // first element in velocities_, number of elements, first element in jacobians_ and responses_
    int first = 0, count = 0, start = 0;
    int begin = 0, end = 0;  // range in which the jacobian is not zero, from `start`
    int next = -1;           // the next block on the same body (CoupleAll())
  };
  // A row, and its state in the iterations.
  struct Row {
    std::array<Block, 2> sides;
    // See Limits. `impulse` is the present solution.
    double target, softness, lower, upper, impulse;
    double mass_inverse;    // J M⁻¹ Jᵀ + softness; 0 if no impulse can move the row
    double change, search;  // last change of the impulse; direction in which Accelerate() continues
    bool is_in_cone;        // whether it is a friction row of a cone, which SolveCone() solves
  };
  // The friction rows of a contact: `first_row` and the row after it.
  struct Cone {
    int normal_row, first_row;  // indices of rows; `normal_row` is the normal of the contact
    double friction;            // coefficient of friction
    Axes axes;                  // axes of its two rows, relative to the axes passed to AddCone()
    double coupling;            // softness between its two rows: velocity of one row for a unit
                                // impulse of the other
    // result of the last search for the limiting friction impulse, from which the next search
    // starts (see WithinCircle())
    double shift;
  };

  Row& At(int row) { return rows_[static_cast<std::size_t>(row)]; }
  // Stores the jacobian and the response of a row on one body.
  Block AddSide(const Side& side);
  // Computes the row's mass_inverse.
  void Weigh(Row& row) const;
  // Limits each block to the range in which its jacobian is not zero.
  void Trim();
  // Returns the effect of a unit impulse of one row on the velocity of the other.
  double Coupling(const Row& a, const Row& b) const;
  // Replaces two rows by weighted sums of both.
  void Combine(int first_row, const Axes& axes);
  // Returns the row's velocity J v.
  double VelocityOf(const Row& row) const;
  // Adds `impulse` to the row's impulse, and its effect to the velocities.
  void Apply(Row& row, double impulse);
  // Solves one row, with all other impulses unchanged.
  void SolveRow(Row& row);
  // Solves a friction cone, with all other impulses unchanged.
  void SolveCone(Cone& cone);
  // Solves each row and cone once.
  void Sweep(bool backwards);
  // Continues each impulse in the direction of its last change.
  void Accelerate(double beta);
  // Returns the largest change of a row's velocity in the last iteration.
  double MaxChange() const;
  // Returns the maximum friction impulse of a cone.
  double RadiusOf(const Cone& cone) const;
  // Computes couplings_, unless they are known.
  void CoupleAll();
  // Lists in free_ the rows of the linear equations.
  void ChooseFree();
  // Returns the velocity that the softness of a cone's rows permits.
  std::array<double, 2> GiveOf(const Cone& cone) const;
  // Returns the velocity that a cone's rows lack to reach their targets.
  std::array<double, 2> MissingOf(const Cone& cone) const;
  // Writes the linear equations of a contact that slips.
  void WriteSlip(const Cone& cone);
  // Writes the linear equations of the rows in free_. With `shares_loads`, redundant rows share the
  // load.
  void WriteEquations(bool shares_loads);
  // Applies the solution of the linear equations, within the bounds of all rows.
  void TakeSolution();
  // Solves the linear equations of the rows in free_, whose impulses are not at a bound. Returns
  // false if this fails.
  bool SolveFree(bool shares_loads);
  // Lists in free_ the rows that probably get an impulse. Returns false if Guess() cannot use them:
  // there are none or too many, or a row already has an impulse.
  bool ChooseLikely();
  // Tries to find the solution from the velocities alone. Returns false, and changes nothing, if
  // this fails.
  bool Guess();
  // Applies the guessed impulses. Returns false if one of them is outside of its bounds.
  bool TakeGuess();
  // Stores the impulses and velocities. GoBack() restores them.
  void Remember();
  // Restores the impulses and velocities that Remember() stored.
  void GoBack();
  // The change of energy by all rows in the last iteration; it is small near the solution.
  double ChangeOfEnergy() const;

  // The velocities of all bodies, and the jacobians and responses of all rows.
  std::vector<double> velocities_, jacobians_, responses_;
  std::vector<Row> rows_;
  std::vector<Cone> cones_;

  // The linear equations of the rows that are within their bounds.
  std::vector<double> couplings_;  // J M⁻¹ Jᵀ of all rows, computed on first use
  std::vector<int> free_;          // rows of the linear equations
  std::vector<int> place_;         // index of each row in free_, or -1
  std::vector<int> last_block_;    // index of each body's last block, or -1
  std::vector<bool> slips_;        // for each cone, whether its friction is at its limit
  std::vector<int> slipping_;      // cones that slip in a direction that does not change
  // For each cone that slips, whether its direction may change.
  std::vector<bool> turns_;
  std::vector<double> matrix_, unknown_;                     // matrix and unknowns of free_
  std::vector<double> velocities_before_, impulses_before_;  // see Remember()
};

// The callers of these functions are compiled once for each instruction set, so these functions
// must be inlined.
[[gnu::always_inline]] inline double ImpulseRows::VelocityOf(const Row& row) const {
  double sum = 0;
  for (const Block& side : row.sides) {
    sum += Product(jacobians_.data() + side.start, velocities_.data() + side.first, side.begin,
                   side.end);
  }
  return sum;
}

[[gnu::always_inline]] inline void ImpulseRows::Apply(Row& row, double impulse) {
  row.impulse += impulse;
  for (const Block& side : row.sides) {
    AddTimes(impulse, responses_.data() + side.start, side.count, velocities_.data() + side.first);
  }
}

}  // namespace gsv::dynamics
