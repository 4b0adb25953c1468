#include "gsv/dynamics/rigid/impulse_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/base/each_processor.h"

namespace gsv::dynamics {
namespace {

// Returns the impulses x = (x0, x1) with the least energy within a circle. The matrix a = (a0, a1)
// is diagonal, with both values above 0, and b = (b0, b1) is the right side. If the solution of a x
// = b is within the circle, it is the result. Otherwise the result is the x on the circle with (a +
// shift) x = b. Newton's method on 1 / |x(shift)| approaches this solution monotonically from below
// (Moré and Sorensen 1983). It begins at `shift`.
[[gnu::always_inline]] inline std::array<double, 2> WithinCircle(double a0, double a1, double b0,
                                                                 double b1, double radius,
                                                                 double& shift) {
  double x0 = b0 / a0, x1 = b1 / a1;
  double length2 = x0 * x0 + x1 * x1;
  if (length2 <= radius * radius) return {x0, x1};
  if (!(radius > 0)) return {0, 0};
  // The length is at most |b| / (least a + shift), and at least |b| / (greatest a + shift).
  const double pull = std::sqrt(b0 * b0 + b1 * b1) / radius;
  shift = std::clamp(shift, std::max(0.0, pull - std::max(a0, a1)),
                     std::max(0.0, pull - std::min(a0, a1)));
  for (int i = 0; i < 12; ++i) {
    const double w0 = 1 / (a0 + shift), w1 = 1 / (a1 + shift);
    x0 = b0 * w0;
    x1 = b1 * w1;
    length2 = x0 * x0 + x1 * x1;
    const double length = std::sqrt(length2);
    if (std::abs(length - radius) <= 1e-12 * radius) break;
    const double slope = x0 * x0 * w0 + x1 * x1 * w1;
    shift = std::max(0.0, shift + length2 / slope * (length - radius) / radius);
  }
  const double scale = radius / std::sqrt(length2);
  return {x0 * scale, x1 * scale};
}

// Returns the axes that make a symmetric matrix of two rows diagonal.
ImpulseRows::Axes PrincipalAxesOf(double a, double b, double coupling) {
  const double angle = 0.5 * std::atan2(2 * coupling, a - b);
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{c, s}, {-s, c}}};
}

}  // namespace

void ImpulseRows::Clear() {
  velocities_.clear();
  jacobians_.clear();
  responses_.clear();
  rows_.clear();
  cones_.clear();
}

int ImpulseRows::AddBody(std::span<const double> velocities) {
  const int first = static_cast<int>(velocities_.size());
  velocities_.insert(velocities_.end(), velocities.begin(), velocities.end());
  velocities_.resize(static_cast<std::size_t>(RoundUpToFour(static_cast<int>(velocities_.size()))));
  return first;
}

std::span<const double> ImpulseRows::velocities(int first, int count) const {
  return std::span(velocities_)
      .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
}

ImpulseRows::Block ImpulseRows::AddSide(const Side& side) {
  GSV_CHECK(side.jacobian.size() == side.response.size());
  const int count = RoundUpToFour(static_cast<int>(side.jacobian.size()));
  const Block block{side.first, count, static_cast<int>(jacobians_.size()), 0, count};
  jacobians_.insert(jacobians_.end(), side.jacobian.begin(), side.jacobian.end());
  responses_.insert(responses_.end(), side.response.begin(), side.response.end());
  jacobians_.resize(static_cast<std::size_t>(block.start + count));
  responses_.resize(static_cast<std::size_t>(block.start + count));
  return block;
}

int ImpulseRows::AddRow(const Side& a, const Side& b, const Limits& limits, double impulse) {
  Row row{{AddSide(a), AddSide(b)},
          limits.target,
          limits.softness,
          limits.lower,
          limits.upper,
          impulse,
          0,
          0,
          0,
          false};
  Weigh(row);
  rows_.push_back(row);
  return static_cast<int>(rows_.size()) - 1;
}

// Both rows must act on the same bodies.
double ImpulseRows::Coupling(const Row& a, const Row& b) const {
  double sum = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    sum += Product(jacobians_.data() + a.sides[side].start, responses_.data() + b.sides[side].start,
                   0, a.sides[side].count);
  }
  return sum;
}

void ImpulseRows::Weigh(Row& row) const {
  constexpr double kNothing = 1e-15;
  const double moved = Coupling(row, row);
  row.mass_inverse = moved > kNothing ? moved + row.softness : 0;
}

// Shortens each block to the range in which its jacobian is not zero. A joint's row, for example,
// acts on one velocity only.
void ImpulseRows::Trim() {
  for (Row& row : rows_) {
    for (Block& side : row.sides) {
      const double* jacobian = jacobians_.data() + side.start;
      while (side.end > side.begin && jacobian[side.end - 1] == 0) --side.end;
      while (side.begin < side.end && jacobian[side.begin] == 0) ++side.begin;
      if (side.begin == side.end) side.count = 0;
      side.begin = side.begin / kFour * kFour;
      side.end = RoundUpToFour(side.end);
    }
  }
}

// Replaces the two rows by weighted sums of both.
void ImpulseRows::Combine(int first_row, const Axes& axes) {
  Row &a = At(first_row), &b = At(first_row + 1);
  for (std::size_t side = 0; side < 2; ++side) {
    for (int i = 0; i < a.sides[side].count; ++i) {
      for (auto* values : {&jacobians_, &responses_}) {
        double& of_a = (*values)[static_cast<std::size_t>(a.sides[side].start + i)];
        double& of_b = (*values)[static_cast<std::size_t>(b.sides[side].start + i)];
        const double was_a = of_a, was_b = of_b;
        of_a = axes[0][0] * was_a + axes[0][1] * was_b;
        of_b = axes[1][0] * was_a + axes[1][1] * was_b;
      }
    }
  }
  const double target_a = a.target, target_b = b.target;
  a.target = axes[0][0] * target_a + axes[0][1] * target_b;
  b.target = axes[1][0] * target_a + axes[1][1] * target_b;
  const double impulse_a = a.impulse, impulse_b = b.impulse;
  a.impulse = axes[0][0] * impulse_a + axes[0][1] * impulse_b;
  b.impulse = axes[1][0] * impulse_a + axes[1][1] * impulse_b;
}

int ImpulseRows::AddCone(int normal_row, int first_row, double friction, const Axes& axes,
                         const std::array<double, 2>& softness) {
  Combine(first_row, axes);
  const Row &a = At(first_row), &b = At(first_row + 1);
  // Rotates both rows to the principal axes of J M⁻¹ Jᵀ + softness. In these axes, the matrix is
  // diagonal: the rows' coupling by the bodies and their coupling by the softness add up to 0.
  const Axes principal =
      PrincipalAxesOf(Coupling(a, a) + softness[0], Coupling(b, b) + softness[1], Coupling(a, b));
  Combine(first_row, principal);
  const auto soft = [&](std::size_t i, std::size_t j) {
    return principal[i][0] * softness[0] * principal[j][0] +
           principal[i][1] * softness[1] * principal[j][1];
  };
  for (std::size_t i = 0; i < 2; ++i) {
    Row& row = At(first_row + static_cast<int>(i));
    row.is_in_cone = true;
    row.softness = soft(i, i);
    Weigh(row);
  }
  cones_.push_back({normal_row, first_row, friction, principal, soft(0, 1), 0});
  return static_cast<int>(cones_.size()) - 1;
}

std::array<double, 2> ImpulseRows::ConeImpulse(int cone) const {
  const Cone& of = cones_[static_cast<std::size_t>(cone)];
  const double x0 = impulse(of.first_row), x1 = impulse(of.first_row + 1);
  return {of.axes[0][0] * x0 + of.axes[1][0] * x1, of.axes[0][1] * x0 + of.axes[1][1] * x1};
}

[[gnu::always_inline]] inline void ImpulseRows::SolveRow(Row& row) {
  if (row.mass_inverse == 0) return;
  const double missing = row.target - VelocityOf(row) - row.softness * row.impulse;
  const double wanted = row.impulse + missing / row.mass_inverse;
  row.change = std::clamp(wanted, row.lower, row.upper) - row.impulse;
  Apply(row, row.change);
}

[[gnu::always_inline]] inline void ImpulseRows::SolveCone(Cone& cone) {
  Row &a = At(cone.first_row), &b = At(cone.first_row + 1);
  const double radius = RadiusOf(cone);
  // If the bodies can move in one direction only, each row has its own bounds.
  if (a.mass_inverse == 0 || b.mass_inverse == 0) {
    for (Row* row : {&a, &b}) {
      row->lower = -radius;
      row->upper = radius;
      SolveRow(*row);
    }
    return;
  }
  const double give_a = a.softness * a.impulse + cone.coupling * b.impulse;
  const double give_b = b.softness * b.impulse + cone.coupling * a.impulse;
  const double pull_a = a.target - VelocityOf(a) - give_a + a.mass_inverse * a.impulse;
  const double pull_b = b.target - VelocityOf(b) - give_b + b.mass_inverse * b.impulse;
  const auto [x, y] =
      WithinCircle(a.mass_inverse, b.mass_inverse, pull_a, pull_b, radius, cone.shift);
  a.change = x - a.impulse;
  b.change = y - b.impulse;
  Apply(a, a.change);
  Apply(b, b.change);
}

GSV_FOR_EACH_PROCESSOR
void ImpulseRows::Sweep(bool backwards) {
  const std::size_t count = rows_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Row& row = rows_[backwards ? count - 1 - i : i];
    if (!row.is_in_cone) SolveRow(row);
  }
  for (Cone& cone : cones_) SolveCone(cone);
}

// Extrapolates along the direction of the previous iterations, within the bounds.
GSV_FOR_EACH_PROCESSOR
void ImpulseRows::Accelerate(double beta) {
  for (Row& row : rows_) {
    if (row.is_in_cone || row.mass_inverse == 0) continue;
    const double step =
        std::clamp(row.impulse + beta * row.search, row.lower, row.upper) - row.impulse;
    Apply(row, step);
    row.search = step + row.change;
  }
  for (const Cone& cone : cones_) {
    Row &a = At(cone.first_row), &b = At(cone.first_row + 1);
    double x = a.impulse + beta * a.search, y = b.impulse + beta * b.search;
    const double radius = RadiusOf(cone);
    const double length = std::sqrt(x * x + y * y);
    if (length > radius) {
      x *= radius / length;
      y *= radius / length;
    }
    const double step_a = x - a.impulse, step_b = y - b.impulse;
    Apply(a, step_a);
    Apply(b, step_b);
    a.search = step_a + a.change;
    b.search = step_b + b.change;
  }
}

double ImpulseRows::MaxChange() const {
  double largest = 0;
  for (const Row& row : rows_) {
    largest = std::max(largest, std::abs(row.mass_inverse * row.change));
  }
  return largest;
}

double ImpulseRows::RadiusOf(const Cone& cone) const {
  return cone.friction * std::max(impulse(cone.normal_row), 0.0);
}

void ImpulseRows::Remember() {
  velocities_before_ = velocities_;
  impulses_before_.clear();
  for (const Row& row : rows_) impulses_before_.push_back(row.impulse);
}

void ImpulseRows::GoBack() {
  velocities_ = velocities_before_;
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].impulse = impulses_before_[i];
}

// The change of energy by all rows in the last iteration: it measures the distance from the
// solution.
double ImpulseRows::ChangeOfEnergy() const {
  double energy = 0;
  for (const Row& row : rows_) energy += row.mass_inverse * row.change * row.change;
  return energy;
}

int ImpulseRows::Solve(int max_iterations, double tolerance) {
  // With at most kFew rows, a direct solution is cheap, so it follows every second iteration. With
  // more rows, it follows every seventh iteration. If a direct solution makes other rows reach
  // their bounds, it may lead away from the result. Then it is undone, and the number of iterations
  // before the next one is about tripled. Only the first direct solution, which may be that of
  // Guess(), distributes loads; see "Loads" in the header.
  constexpr std::size_t kFew = 60;
  const int sweeps = rows_.size() <= kFew ? 1 : 6;
  Trim();
  couplings_.clear();
  const bool is_guessed = Guess();
  double energy_before = 0, last_energy = 0;
  int wait = sweeps, since = 0;
  bool is_first = !is_guessed, is_direct = false;
  for (int iteration = 1; iteration < max_iterations; ++iteration) {
    Sweep(iteration % 2 == 0);
    ++since;
    const bool is_solved = MaxChange() <= tolerance;
    const double energy = ChangeOfEnergy();
    if (is_solved && !is_first) return iteration;
    const bool was_direct = std::exchange(is_direct, false);
    if (was_direct && energy > energy_before) {
      GoBack();
      wait *= 3;
    } else {
      energy_before = energy;
    }
    if (is_solved || since > wait) {
      Remember();
      is_direct = SolveFree(is_first);
      if (!is_direct && is_solved) return iteration;
      if (!is_direct) wait *= 3;
      is_first = false;
      since = 0;
    } else if (since > 1 && energy <= last_energy) {
      Accelerate(energy / last_energy);
    } else {
      for (Row& row : rows_) row.search = was_direct ? 0 : row.change;
    }
    last_energy = energy;
  }
  Sweep(max_iterations % 2 == 0);
  return max_iterations;
}

}  // namespace gsv::dynamics
