// Constraint rows on the joints of one tree of links.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace gsv::dynamics {

// A row requires J v + softness * impulse = target, where v are the tree's velocities at the end of
// a substep. Its impulse (N m s or N s) has bounds.
struct JointRow {
  int begin = 0, count = 0;     // range of its velocities and values in JointRows
  double target = 0;            // rad/s or m/s
  double softness = 0;          // velocity per impulse
  double lower = 0, upper = 0;  // bounds of the impulse
};

// A list of constraint rows on the joints of one tree of links.
class JointRows {
 public:
  // The bound of an impulse without limit.
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  // Removes all rows.
  void Clear() {
    rows_.clear();
    velocities_.clear();
    values_.clear();
  }
  // Adds a row on one velocity of the tree.
  JointRow& Add(int velocity) {
    rows_.push_back({static_cast<int>(values_.size()), 0, 0, 0, -kNoBound, kNoBound});
    AddValue(velocity, 1);
    return rows_.back();
  }
  // Adds a row without velocities. AddValue() then adds them.
  JointRow& AddEmpty() {
    return rows_.emplace_back(
        JointRow{static_cast<int>(values_.size()), 0, 0, 0, -kNoBound, kNoBound});
  }
  // Adds a velocity to the last row. A row must not contain a velocity twice.
  void AddValue(int velocity, double value) {
    velocities_.push_back(velocity);
    values_.push_back(value);
    ++rows_.back().count;
  }

  const std::vector<JointRow>& rows() const { return rows_; }
  // The velocities on which a row acts.
  std::span<const int> velocities(const JointRow& row) const {
    return std::span(velocities_)
        .subspan(static_cast<std::size_t>(row.begin), static_cast<std::size_t>(row.count));
  }
  // The jacobian of a row: one value for each of velocities(row).
  std::span<const double> values(const JointRow& row) const {
    return std::span(values_).subspan(static_cast<std::size_t>(row.begin),
                                      static_cast<std::size_t>(row.count));
  }

 private:
  std::vector<JointRow> rows_;
  // For all rows, one row after the other: indices of the tree's velocities, and the jacobian's
  // value for each of them.
  std::vector<int> velocities_;
  std::vector<double> values_;
};

}  // namespace gsv::dynamics
