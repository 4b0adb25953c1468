// Newton's method of IslandSolver.
#include <algorithm>
#include <cmath>

#include "gsv/base/each_processor.h"
#include "gsv/dynamics/motion/solver_count.h"
#include "gsv/dynamics/rigid/island_solver.h"
#include "gsv/dynamics/rigid/linear_solve.h"

namespace gsv::dynamics {
namespace {

std::size_t Of(int i) { return static_cast<std::size_t>(i); }

}  // namespace

// Rows are active if their impulse may have both signs, or if their bounds allow an impulse towards
// their target velocity. Contacts that close stick if they have friction and their tangential speed
// is at most kSlips. Otherwise, they slip. All other contacts are open.
void IslandSolver::Guess() {
  constexpr double kSlips = 1e-3;  // m/s
  for (Row& row : rows_) {
    const double missing = row.target - VelocityOf(row, free_);
    row.impulse = 0;
    row.is_active = (row.lower < 0 && row.upper > 0) || (row.upper > 0 && missing > 0) ||
                    (row.lower < 0 && missing < 0);
  }
  for (ContactRows& rows : contact_rows_) {
    const auto [normal, first, second] = VelocityAt(rows, free_);
    rows.normal.impulse = 0;
    rows.impulse = {};
    rows.turning = 0;
    rows.mode = ContactRows::Mode::kOpen;
    if (!(rows.normal.target - normal > 0)) continue;
    const double x = rows.target[0] - first, y = rows.target[1] - second;
    const double slip = std::sqrt(x * x + y * y);
    if (rows.friction > 0 && !(slip > kSlips)) {
      rows.mode = ContactRows::Mode::kSticks;
      continue;
    }
    rows.mode = ContactRows::Mode::kSlips;
    rows.direction = rows.friction > 0 ? std::array{x / slip, y / slip} : std::array{0.0, 0.0};
  }
}

void IslandSolver::AddRow(const Row& row) {
  const int* const columns = columns_.data() + row.begin;
  const double* const values = values_.data() + row.values;
  double known = row.impulse;
  if (row.is_active) {
    const double stiffness = 1 / (row.compliance + row.softness);
    known = stiffness * (row.compliance * row.impulse + row.target);
    for (int i = 0; i < row.count; ++i) {
      double* const equation = matrix_.data() + Of(columns[i]) * Of(size_);
      for (int j = 0; j < row.count; ++j) {
        equation[columns[j]] += stiffness * values[i] * values[j];
      }
    }
  }
  for (int i = 0; i < row.count; ++i) unknown_[Of(columns[i])] += values[i] * known;
}

// If a contact slips, a unit impulse along the normal causes a friction impulse along the direction
// of slip. If the softness differs between the tangents, this friction impulse also permits a
// velocity across that direction, which is returned.
double IslandSolver::CouplingOf(const ContactRows& rows) {
  const auto [x, y] = rows.direction;
  return rows.friction * x * y * (rows.softness[1] - rows.softness[0]);
}

// The impulses of the contact are `known` - G u, where u are its velocities.
void IslandSolver::AddContactEquations(const ContactRows& rows) {
  const Row& normal = rows.normal;
  if (rows.mode == ContactRows::Mode::kOpen) return;
  const int* const columns = columns_.data() + normal.begin;
  const double* const n = values_.data() + normal.values;
  const double *const a = n + normal.count, *const b = a + normal.count;
  const double stiffness = 1 / (normal.compliance + normal.softness);
  const double known = stiffness * (normal.compliance * normal.impulse + normal.target);
  if (rows.mode == ContactRows::Mode::kSticks) {
    const double sa = 1 / (rows.compliance[0] + rows.softness[0]);
    const double sb = 1 / (rows.compliance[1] + rows.softness[1]);
    const double ka = sa * (rows.compliance[0] * rows.impulse[0] + rows.target[0]);
    const double kb = sb * (rows.compliance[1] * rows.impulse[1] + rows.target[1]);
    for (int i = 0; i < normal.count; ++i) {
      double* const equation = matrix_.data() + Of(columns[i]) * Of(size_);
      const double wn = stiffness * n[i], wa = sa * a[i], wb = sb * b[i];
      for (int j = 0; j < normal.count; ++j) {
        equation[columns[j]] += wn * n[j] + wa * a[j] + wb * b[j];
      }
      unknown_[Of(columns[i])] += n[i] * known + a[i] * ka + b[i] * kb;
    }
    return;
  }
  const auto [x, y] = rows.direction;
  const double turning = rows.turning, coupling = CouplingOf(rows);
  const double across = turning * (x * rows.target[1] - y * rows.target[0] - coupling * known);
  for (int i = 0; i < normal.count; ++i) {
    double* const equation = matrix_.data() + Of(columns[i]) * Of(size_);
    const double along_i = x * a[i] + y * b[i], across_i = x * b[i] - y * a[i];
    const double wn = stiffness * (n[i] + rows.friction * along_i), wt = turning * across_i;
    for (int j = 0; j < normal.count; ++j) {
      equation[columns[j]] += wn * n[j] + wt * (x * b[j] - y * a[j] - coupling * stiffness * n[j]);
    }
    unknown_[Of(columns[i])] += (n[i] + rows.friction * along_i) * known + across_i * across;
  }
}

void IslandSolver::WriteEquations(std::span<const std::unique_ptr<MovingBody>> bodies) {
  matrix_.assign(Of(size_) * Of(size_), 0);
  unknown_ = momenta_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const LinkTree& tree = bodies[Of(bodies_[b])]->tree();
    const int first = first_[b];
    for (int i = 0; i < tree.size(); ++i) {
      for (int j = 0; j <= i; ++j) {
        const double mass = tree.mass(i, j);
        matrix_[Of(first + i) * Of(size_) + Of(first + j)] = mass;
        matrix_[Of(first + j) * Of(size_) + Of(first + i)] = mass;
      }
    }
  }
  for (const Row& row : rows_) AddRow(row);
  for (const ContactRows& rows : contact_rows_) AddContactEquations(rows);
}

void IslandSolver::TakeImpulses() {
  for (Row& row : rows_) {
    if (!row.is_active) continue;
    row.impulse = (row.compliance * row.impulse + row.target - VelocityOf(row, velocities_)) /
                  (row.compliance + row.softness);
  }
  for (ContactRows& rows : contact_rows_) {
    rows.velocity = VelocityAt(rows, velocities_);
    if (rows.mode == ContactRows::Mode::kOpen) continue;
    Row& normal = rows.normal;
    normal.impulse = (normal.compliance * normal.impulse + normal.target - rows.velocity[0]) /
                     (normal.compliance + normal.softness);
    const double a = rows.target[0] - rows.velocity[1], b = rows.target[1] - rows.velocity[2];
    if (rows.mode == ContactRows::Mode::kSticks) {
      for (std::size_t i = 0; i < 2; ++i) {
        rows.impulse[i] = (rows.compliance[i] * rows.impulse[i] + (i == 0 ? a : b)) /
                          (rows.compliance[i] + rows.softness[i]);
      }
      continue;
    }
    const auto [x, y] = rows.direction;
    const double along = rows.friction * normal.impulse;
    const double across = rows.turning * (x * b - y * a - CouplingOf(rows) * normal.impulse);
    rows.impulse = {along * x - across * y, along * y + across * x};
  }
}

// Chooses whether the contact is open, sticks or slips. Returns the error of its impulses,
// converted to a velocity, m/s.
double IslandSolver::ChooseMode(ContactRows& rows) const {
  Row& normal = rows.normal;
  const double wanted = normal.impulse + normal.stiffness * (normal.target - rows.velocity[0] -
                                                             normal.softness * normal.impulse);
  if (!(wanted > 0)) {
    const double error = std::max({std::abs(normal.impulse) / normal.stiffness,
                                   std::abs(rows.impulse[0]) / rows.stiffness,
                                   std::abs(rows.impulse[1]) / rows.stiffness});
    rows.mode = ContactRows::Mode::kOpen;
    normal.impulse = 0;
    rows.impulse = {};
    return error;
  }
  const double error = std::abs(wanted - normal.impulse) / normal.stiffness;
  if (!(rows.friction > 0)) {
    rows.mode = ContactRows::Mode::kSlips;
    rows.direction = {};
    rows.turning = 0;
    return error;
  }
  const double radius = rows.friction * wanted;
  const auto missing = [&](std::size_t i) {
    return rows.target[i] - rows.velocity[1 + i] - rows.softness[i] * rows.impulse[i];
  };
  const double x = rows.impulse[0] + rows.stiffness * missing(0);
  const double y = rows.impulse[1] + rows.stiffness * missing(1);
  const double length = std::sqrt(x * x + y * y);
  const double scale = length <= radius ? 1 : radius / length;
  const double dx = scale * x - rows.impulse[0], dy = scale * y - rows.impulse[1];
  if (length <= radius) {
    rows.mode = ContactRows::Mode::kSticks;
  } else {
    rows.mode = ContactRows::Mode::kSlips;
    rows.direction = {x / length, y / length};
    const double turning = std::min(scale / (1 - scale) * rows.stiffness,
                                    1 / std::max(rows.compliance[0], rows.compliance[1]));
    // The softness across the direction makes the contact less stiff across the direction.
    const auto [a, b] = rows.direction;
    rows.turning = turning / (1 + turning * (rows.softness[0] * b * b + rows.softness[1] * a * a));
  }
  return std::max(error, std::sqrt(dx * dx + dy * dy) / rows.stiffness);
}

double IslandSolver::ChooseModes() {
  double error = 0;
  for (Row& row : rows_) {
    if (row.stiffness == 0) continue;
    const double wanted = row.impulse + row.stiffness * (row.target - VelocityOf(row, velocities_) -
                                                         row.softness * row.impulse);
    const double within = std::clamp(wanted, row.lower, row.upper);
    error = std::max(error, std::abs(within - row.impulse) / row.stiffness);
    row.is_active = wanted > row.lower && wanted < row.upper;
    if (!row.is_active) row.impulse = within;
  }
  for (ContactRows& rows : contact_rows_) error = std::max(error, ChooseMode(rows));
  return error;
}

bool IslandSolver::SolveByNewton(std::span<const std::unique_ptr<MovingBody>> bodies) {
  constexpr int kMaxIterations = 20;
  constexpr double kTolerance = 1e-9;  // m/s
  Guess();
  for (int iteration = 1; iteration <= kMaxIterations; ++iteration) {
    WriteEquations(bodies);
    if (!SolveLinear(matrix_, unknown_)) return false;
    velocities_ = unknown_;
    TakeImpulses();
    if (ChooseModes() <= kTolerance) {
      CountSolverIterations(iteration);
      return true;
    }
  }
  CountSolverIterations(kMaxIterations);
  return false;
}

}  // namespace gsv::dynamics
