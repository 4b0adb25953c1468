// The direct solution of ImpulseRows: linear equations of the rows that are within their bounds.
#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/base/each_processor.h"
#include "gsv/dynamics/rigid/impulse_rows.h"
#include "gsv/dynamics/rigid/linear_solve.h"

namespace gsv::dynamics {
namespace {

double PlanarLength(const std::array<double, 2>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1]); }

}  // namespace

// Two rows are coupled only if they act on the same body. So the blocks that act on one body form a
// linked list.
GSV_FOR_EACH_PROCESSOR
void ImpulseRows::CoupleAll() {
  const std::size_t count = rows_.size();
  if (couplings_.size() == count * count) return;
  couplings_.assign(count * count, 0);
  last_block_.assign(velocities_.size() / kFour, -1);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      Block& block = rows_[i].sides[side];
      if (block.count == 0) continue;
      int& last = last_block_[static_cast<std::size_t>(block.first / kFour)];
      block.next = std::exchange(last, static_cast<int>(2 * i + side));
    }
    double* const of_row = couplings_.data() + i * count;
    for (const Block& a : rows_[i].sides) {
      if (a.count == 0) continue;
      const double* jacobian = jacobians_.data() + a.start;
      for (int at = last_block_[static_cast<std::size_t>(a.first / kFour)]; at >= 0;) {
        const Block& b = At(at / 2).sides[static_cast<std::size_t>(at % 2)];
        of_row[at / 2] += Product(jacobian, responses_.data() + b.start, a.begin, a.end);
        at = b.next;
      }
    }
    for (std::size_t j = 0; j < i; ++j) couplings_[j * count + i] = of_row[j];
  }
}

// Lists the rows that are strictly within their bounds or at a bound that they might leave, and the
// cones that stick.
void ImpulseRows::ChooseFree() {
  constexpr double kSticks = 1 - 1e-9, kMightLeave = 1e-6;  // m/s
  free_.clear();
  place_.assign(rows_.size(), -1);
  const auto choose = [&](int row) {
    place_[static_cast<std::size_t>(row)] = static_cast<int>(free_.size());
    free_.push_back(row);
  };
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const Row& row = At(i);
    if (row.is_in_cone || row.mass_inverse == 0) continue;
    const bool is_within = row.impulse > row.lower && row.impulse < row.upper;
    const bool is_bounded = row.lower < row.upper;
    if (is_within || (is_bounded && std::abs(row.target - VelocityOf(row)) < kMightLeave)) {
      choose(i);
    }
  }
  slips_.assign(cones_.size(), false);
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& cone = cones_[i];
    const Row &a = At(cone.first_row), &b = At(cone.first_row + 1);
    if (a.mass_inverse == 0 || b.mass_inverse == 0) continue;
    const double radius = RadiusOf(cone);
    if (!(radius > 0)) continue;
    slips_[i] = std::sqrt(a.impulse * a.impulse + b.impulse * b.impulse) >= radius * kSticks;
    if (slips_[i]) continue;
    choose(cone.first_row);
    choose(cone.first_row + 1);
  }
  // If a contact slips, its friction follows the direction of the slip.
  constexpr double kStands = 1e-9;  // m/s
  std::size_t turning = 0;
  for (std::size_t i = 0; i < cones_.size(); ++i) turning += slips_[i] ? 2 : 0;
  turns_.assign(cones_.size(), false);
  if (free_.size() + turning > static_cast<std::size_t>(kMaxDirect)) return;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    if (!slips_[i] || !(PlanarLength(MissingOf(cones_[i])) > kStands)) continue;
    turns_[i] = true;
    choose(cones_[i].first_row);
    choose(cones_[i].first_row + 1);
  }
}

// Returns the change of velocity that a cone's rows still require. It is opposite to the slip.
std::array<double, 2> ImpulseRows::MissingOf(const Cone& cone) const {
  const Row &a = rows_[static_cast<std::size_t>(cone.first_row)],
            &b = rows_[static_cast<std::size_t>(cone.first_row) + 1];
  const auto [give_a, give_b] = GiveOf(cone);
  return {a.target - VelocityOf(a) - give_a, b.target - VelocityOf(b) - give_b};
}

// Returns the velocity that the softness of a cone's rows permits for their impulses.
std::array<double, 2> ImpulseRows::GiveOf(const Cone& cone) const {
  const Row &a = rows_[static_cast<std::size_t>(cone.first_row)],
            &b = rows_[static_cast<std::size_t>(cone.first_row) + 1];
  return {a.softness * a.impulse + cone.coupling * b.impulse,
          b.softness * b.impulse + cone.coupling * a.impulse};
}

// The friction x of a contact that slips is radius * e / |e|, where e is the missing velocity.
// Along e, it changes with the radius; across e, it changes as e rotates. Newton's method includes
// both changes.
void ImpulseRows::WriteSlip(const Cone& cone) {
  const std::size_t n = free_.size(), count = rows_.size();
  const auto first = static_cast<std::size_t>(place_[static_cast<std::size_t>(cone.first_row)]);
  const Row &a = At(cone.first_row), &b = At(cone.first_row + 1);
  const auto [e0, e1] = MissingOf(cone);
  const double length = PlanarLength({e0, e1}), radius = RadiusOf(cone), weight = a.mass_inverse;
  const double d0 = e0 / length, d1 = e1 / length, stiff = length / radius;
  const double* of_a = couplings_.data() + static_cast<std::size_t>(cone.first_row) * count;
  const double* of_b = of_a + count;
  double* along = matrix_.data() + first * n;
  double* across = along + n;
  for (std::size_t j = 0; j < n; ++j) {
    along[j] = 0;
    across[j] = d0 * of_b[free_[j]] - d1 * of_a[free_[j]];
  }
  across[first] += d0 * cone.coupling - d1 * a.softness;
  across[first + 1] += d0 * b.softness - d1 * cone.coupling;
  along[first] = weight * d0;
  along[first + 1] = weight * d1;
  const int normal = place_[static_cast<std::size_t>(cone.normal_row)];
  if (normal >= 0) along[normal] = -weight * cone.friction;
  across[first] -= stiff * d1;
  across[first + 1] += stiff * d0;
  unknown_[first] = weight * (radius - (d0 * a.impulse + d1 * b.impulse));
  unknown_[first + 1] = -stiff * (d0 * b.impulse - d1 * a.impulse);
}

// Writes the velocity error of each free row, and how much each impulse changes it. The friction of
// a contact that slips grows with its normal impulse.
void ImpulseRows::WriteEquations(bool shares_loads) {
  // A box on the ground has four contacts, although three already determine its motion. Springs of
  // this softness (relative to mass_inverse) distribute the load among them.
  constexpr double kRidge = 1e-9;
  const std::size_t n = free_.size(), count = rows_.size();
  matrix_.resize(n * n);
  unknown_.resize(n);
  slipping_.clear();
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    const int normal = place_[static_cast<std::size_t>(cones_[c].normal_row)];
    if (slips_[c] && !turns_[c] && normal >= 0) slipping_.push_back(static_cast<int>(c));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Row& row = At(free_[i]);
    const double* couplings = couplings_.data() + static_cast<std::size_t>(free_[i]) * count;
    for (std::size_t j = 0; j < n; ++j) matrix_[i * n + j] = couplings[free_[j]];
    matrix_[i * n + i] += row.softness + kRidge * row.mass_inverse;
    unknown_[i] = row.target - VelocityOf(row) - row.softness * row.impulse;
    if (shares_loads) unknown_[i] -= kRidge * row.mass_inverse * row.impulse;
    for (const int c : slipping_) {
      const Cone& cone = cones_[static_cast<std::size_t>(c)];
      const double share = 1 / impulse(cone.normal_row);
      matrix_[i * n +
              static_cast<std::size_t>(place_[static_cast<std::size_t>(cone.normal_row)])] +=
          share * (impulse(cone.first_row) * couplings[cone.first_row] +
                   impulse(cone.first_row + 1) * couplings[cone.first_row + 1]);
    }
  }
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    const Cone& cone = cones_[c];
    const int place = place_[static_cast<std::size_t>(cone.first_row)];
    if (turns_[c]) {
      WriteSlip(cone);
    } else if (place >= 0) {
      const auto a = static_cast<std::size_t>(place), b = a + 1;
      matrix_[a * n + b] += cone.coupling;
      matrix_[b * n + a] += cone.coupling;
      unknown_[a] -= cone.coupling * impulse(cone.first_row + 1);
      unknown_[b] -= cone.coupling * impulse(cone.first_row);
    }
  }
}

void ImpulseRows::TakeSolution() {
  for (std::size_t i = 0; i < free_.size(); ++i) {
    Row& row = At(free_[i]);
    if (row.is_in_cone) continue;
    row.change = std::clamp(row.impulse + unknown_[i], row.lower, row.upper) - row.impulse;
  }
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    const Cone& cone = cones_[c];
    Row &a = At(cone.first_row), &b = At(cone.first_row + 1);
    Row& normal = At(cone.normal_row);
    const bool normal_changes = place_[static_cast<std::size_t>(cone.normal_row)] >= 0;
    const double before = normal.impulse;
    const double after = before + (normal_changes ? normal.change : 0);
    const double radius = cone.friction * std::max(after, 0.0);
    const int place = place_[static_cast<std::size_t>(cone.first_row)];
    if (place >= 0) {
      double x = a.impulse + unknown_[static_cast<std::size_t>(place)];
      double y = b.impulse + unknown_[static_cast<std::size_t>(place) + 1];
      const double length = std::sqrt(x * x + y * y);
      if (length > radius) {
        x *= radius / length;
        y *= radius / length;
      }
      Apply(a, x - a.impulse);
      Apply(b, y - b.impulse);
    } else if (slips_[c] && before > 0) {
      Apply(a, a.impulse * (after / before - 1));
      Apply(b, b.impulse * (after / before - 1));
    }
  }
  for (const int i : free_) {
    if (!At(i).is_in_cone) Apply(At(i), At(i).change);
  }
}

bool ImpulseRows::SolveFree(bool shares_loads) {
  ChooseFree();
  if (free_.empty() || free_.size() > static_cast<std::size_t>(kMaxDirect)) return false;
  CoupleAll();
  WriteEquations(shares_loads);
  if (!SolveLinear(matrix_, unknown_)) return false;
  TakeSolution();
  return true;
}

// Lists the rows that may have impulses of both signs, the contacts that close, and the friction
// rows of contacts that do not slip. Returns false if the list is empty or has more than kMaxGuess
// rows, or if any row has an impulse already.
bool ImpulseRows::ChooseLikely() {
  constexpr double kSlips = 1e-3;  // m/s
  constexpr std::size_t kMaxGuess = 60;
  const auto choose = [&](int row) {
    place_[static_cast<std::size_t>(row)] = static_cast<int>(free_.size());
    free_.push_back(row);
  };
  free_.clear();
  place_.assign(rows_.size(), -1);
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const Row& row = At(i);
    if (row.impulse != 0) return false;
    if (row.is_in_cone || row.mass_inverse == 0) continue;
    const double missing = row.target - VelocityOf(row);
    if ((row.lower < 0 && row.upper > 0) || (row.upper > 0 && missing > 0) ||
        (row.lower < 0 && missing < 0)) {
      choose(i);
    }
  }
  slips_.assign(cones_.size(), false);
  turns_.assign(cones_.size(), false);
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& cone = cones_[i];
    if (place_[static_cast<std::size_t>(cone.normal_row)] < 0 || !(cone.friction > 0)) continue;
    if (At(cone.first_row).mass_inverse == 0 || At(cone.first_row + 1).mass_inverse == 0) continue;
    slips_[i] = PlanarLength(MissingOf(cone)) > kSlips;
    if (slips_[i]) continue;
    choose(cone.first_row);
    choose(cone.first_row + 1);
  }
  return !free_.empty() && free_.size() <= kMaxGuess;
}

// The friction of a contact that slips opposes the slip and is proportional to the normal impulse.
// Returns whether the guess is within all bounds.
bool ImpulseRows::Guess() {
  if (!ChooseLikely()) return false;
  Remember();
  CoupleAll();
  // WriteEquations() reads the direction of friction from the impulses of the contact's rows. So
  // these are set to the friction for a normal impulse of 1.
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    if (!slips_[i]) continue;
    const Cone& cone = cones_[i];
    const auto missing = MissingOf(cone);
    const double scale = cone.friction / PlanarLength(missing);
    for (int k = 0; k < 2; ++k) At(cone.first_row + k).impulse = scale * missing[k];
    At(cone.normal_row).impulse = 1;
  }
  WriteEquations(false);
  for (const Cone& cone : cones_) {
    Row& normal = At(cone.normal_row);
    const int place = place_[static_cast<std::size_t>(cone.normal_row)];
    if (place >= 0) unknown_[static_cast<std::size_t>(place)] += normal.softness * normal.impulse;
    normal.impulse = 0;
  }
  const bool is_solved = SolveLinear(matrix_, unknown_);
  if (is_solved && TakeGuess()) return true;
  GoBack();
  return false;
}

bool ImpulseRows::TakeGuess() {
  for (std::size_t i = 0; i < free_.size(); ++i) {
    Row& row = At(free_[i]);
    if (row.is_in_cone) continue;
    if (unknown_[i] < row.lower || unknown_[i] > row.upper) return false;
    Apply(row, unknown_[i]);
  }
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& cone = cones_[i];
    const int place = place_[static_cast<std::size_t>(cone.first_row)];
    std::array<double, 2> wanted{};
    for (int k = 0; k < 2; ++k) {
      Row& row = At(cone.first_row + k);
      if (slips_[i]) wanted[k] = row.impulse * impulse(cone.normal_row);
      if (place >= 0) wanted[k] = unknown_[static_cast<std::size_t>(place + k)];
      row.impulse = 0;
    }
    if (!slips_[i] && PlanarLength(wanted) > RadiusOf(cone)) return false;
    for (int k = 0; k < 2; ++k) Apply(At(cone.first_row + k), wanted[k]);
  }
  return true;
}

}  // namespace gsv::dynamics
