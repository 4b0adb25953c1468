#include "gsv/verdict/margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/verdict/measure.h"

namespace gsv::verdict {
namespace {

using FormulaKind = scenario::Formula::Kind;
using What = scenario::Quantity::Kind;

bool IsMeasured(const scenario::Formula& condition) {
  if (condition.kind == FormulaKind::kAtom) {
    return condition.quantity.kind != What::kContact && condition.quantity.kind != What::kEnded;
  }
  const bool is_condition = condition.kind == FormulaKind::kNot ||
                            condition.kind == FormulaKind::kAll ||
                            condition.kind == FormulaKind::kAny;
  return is_condition && !condition.parts.empty() &&
         std::all_of(condition.parts.begin(), condition.parts.end(), IsMeasured);
}

const scenario::Formula& FirstAtom(const scenario::Formula& condition) {
  return condition.kind == FormulaKind::kAtom ? condition : FirstAtom(condition.parts.front());
}

// Returns the signed distance of a condition to its limit; NaN if a value is missing. `values` has
// one value for each atom. `next` is the index of the condition's first atom. This function
// increases it by the number of the condition's atoms.
double Distance(const scenario::Formula& condition,
                const std::vector<std::optional<double>>& values, std::size_t& next) {
  if (condition.kind == FormulaKind::kAtom) {
    const std::optional<double> value = values.at(next++);
    if (!value) return std::nan("");
    // An infinite value is infinitely far from a bound that is not there.
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return std::min(condition.min == -kNone ? kNone : *value - condition.min,
                    condition.max == kNone ? kNone : condition.max - *value);
  }
  double distance = 0;
  for (std::size_t i = 0; i < condition.parts.size(); ++i) {
    const double part = Distance(condition.parts[i], values, next);
    if (i == 0) {
      distance = part;
    } else if (std::isnan(part) || std::isnan(distance)) {
      distance = std::nan("");
    } else {
      distance =
          condition.kind == FormulaKind::kAny ? std::max(distance, part) : std::min(distance, part);
    }
  }
  return condition.kind == FormulaKind::kNot ? -distance : distance;
}

}  // namespace

std::optional<Margin> MarginOf(const scenario::Formula& formula) {
  const bool is_temporal =
      formula.kind == FormulaKind::kAlways || formula.kind == FormulaKind::kEventually;
  if (!is_temporal || formula.parts.empty() || !IsMeasured(formula.parts[0])) return std::nullopt;
  Margin margin;
  margin.condition_ = formula.parts[0];
  margin.must_come_ = formula.kind == FormulaKind::kEventually;
  margin.from_ = base::FromSeconds(formula.from);
  if (formula.by) margin.by_ = base::FromSeconds(*formula.by);
  margin.unit_ = UnitOf(FirstAtom(margin.condition_).quantity);
  margin.unit_.erase(0, margin.unit_.find_first_not_of(' '));
  return margin;
}

void Margin::Note(base::SimTime now, const std::vector<std::optional<double>>& values) {
  if (now < from_ || (by_ && now > *by_)) return;
  std::size_t next = 0;
  const double distance = Distance(condition_, values, next);
  if (!std::isfinite(distance)) return;
  if (margin_ && (must_come_ ? distance <= *margin_ : distance >= *margin_)) return;
  margin_ = distance;
  at_ = now;
}

void Margin::Fill(simulation::ExpectationState& state) const {
  state.margin = margin_;
  state.margin_at = at_;
  state.unit = unit_;
}

void AddShapes(const scenario::Formula& formula, simulation::ExpectationState& state) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  simulation::ExpectationState::Box box{-kNone, kNone, -kNone, kNone};
  bool has_box = false;
  const auto note = [&](const scenario::Formula& atom) {
    if (atom.quantity.kind == What::kDistanceToPoint) {
      state.places.push_back({atom.quantity.x, atom.quantity.y, atom.max});
    } else if (atom.quantity.kind == What::kX) {
      has_box = true;
      box.x_min = atom.min;
      box.x_max = atom.max;
    } else if (atom.quantity.kind == What::kY) {
      has_box = true;
      box.y_min = atom.min;
      box.y_max = atom.max;
    }
  };
  if (formula.kind == FormulaKind::kAtom) note(formula);
  for (const scenario::Formula& part : formula.parts) {
    if (part.kind == FormulaKind::kAtom) {
      note(part);
    } else {
      AddShapes(part, state);
    }
  }
  if (has_box) state.boxes.push_back(box);
}

}  // namespace gsv::verdict
