#include "gsv/dynamics/rigid/overlap_removal.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {

using geometry::Vector3;

void OverlapRemoval::Clear() {
  bodies_.clear();
  rows_.clear();
}

int OverlapRemoval::AddBody(double inverse_mass) {
  bodies_.push_back({inverse_mass, {}});
  return static_cast<int>(bodies_.size()) - 1;
}

void OverlapRemoval::AddContact(int first, int second, const Vector3& normal, double gap) {
  if (!rows_.empty()) {
    Row& last = rows_.back();
    if (last.first == first && last.second == second && last.normal == normal) {
      last.gap = std::min(last.gap, gap);
      return;
    }
  }
  rows_.push_back({first, second, normal, gap});
}

// Solves one contact. Returns the change of its velocity, m/s.
inline double OverlapRemoval::SolveRow(Row& row) {
  double speed = 0;
  if (row.first >= 0) speed += Dot(row.normal, At(row.first).velocity);
  if (row.second >= 0) speed -= Dot(row.normal, At(row.second).velocity);
  const double impulse = std::max(0.0, row.impulse + (row.target - speed) * row.mass);
  const double change = impulse - row.impulse;
  if (change == 0) return 0;
  row.impulse = impulse;
  if (row.first >= 0) {
    Body& body = At(row.first);
    body.velocity += (change * body.inverse_mass) * row.normal;
  }
  if (row.second >= 0) {
    Body& body = At(row.second);
    body.velocity -= (change * body.inverse_mass) * row.normal;
  }
  return std::abs(change) / row.mass;
}

bool OverlapRemoval::Solve(double substep) {
  constexpr int kMaxSweeps = 10;
  // m/s: slower motion is neglected, and does not wake a body at rest
  constexpr double kMinSpeed = 1e-4;
  // Sweeps end if no velocity changes by more than this fraction of the greatest target.
  constexpr double kTolerance = 0.02;
  double greatest = 0;
  for (Row& row : rows_) {
    row.target = -(row.gap < 0 ? kShare : 1) * row.gap / substep;
    greatest = std::max(greatest, row.target);
  }
  if (!(greatest > kMinSpeed)) return false;
  for (Row& row : rows_) {
    double moved = 0;
    if (row.first >= 0) moved += At(row.first).inverse_mass;
    if (row.second >= 0) moved += At(row.second).inverse_mass;
    row.mass = moved > 0 ? 1 / moved : 0;
  }
  std::erase_if(rows_, [](const Row& row) { return !(row.mass > 0); });
  const double tolerance = std::max(kMinSpeed, kTolerance * greatest);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double change = 0;
    if (sweep % 2 == 0) {
      for (auto row = rows_.begin(); row != rows_.end(); ++row) {
        change = std::max(change, SolveRow(*row));
      }
    } else {
      for (auto row = rows_.rbegin(); row != rows_.rend(); ++row) {
        change = std::max(change, SolveRow(*row));
      }
    }
    if (change <= tolerance) break;
  }
  Limit();
  return true;
}

// Scales all velocities so that none exceeds kMaxSpeed. Then bodies that overlap separate more
// slowly, and other bodies still approach by no more than their gap.
void OverlapRemoval::Limit() {
  double square = 0;
  for (const Body& body : bodies_) square = std::max(square, Dot(body.velocity, body.velocity));
  if (!(square > kMaxSpeed * kMaxSpeed)) return;
  const double scale = kMaxSpeed / std::sqrt(square);
  for (Body& body : bodies_) body.velocity = scale * body.velocity;
}

}  // namespace gsv::dynamics
