#include "gsv/verdict/monitor.h"

#include <algorithm>
#include <tuple>

#include "gsv/base/check.h"
#include "gsv/base/sorting.h"

namespace gsv::verdict {

using base::SimTime;

// A formula in negation normal form. For the four temporal operators, `from` and `by` are at first
// relative to the instant of evaluation. After the evaluation, they are instants of simulated time.
class Obligation {
 public:
  enum class Kind { kFalse, kTrue, kAtom, kAll, kAny, kAlways, kEventually, kUntil, kRelease };

  Kind kind = Kind::kTrue;
  int atom = 0;
  bool is_negated = false;  // for kAtom only
  bool is_judged = false;   // whether `from` and `by` are instants of simulated time
  SimTime from{0}, by{0};
  std::vector<ObligationPtr> parts;
};

namespace {

using Kind = Obligation::Kind;

constexpr SimTime kForever = SimTime::max();

ObligationPtr Constant(bool value) {
  static const auto always_true = std::make_shared<const Obligation>();
  static const auto always_false =
      std::make_shared<const Obligation>(Obligation{.kind = Kind::kFalse});
  return value ? always_true : always_false;
}

// Compares two obligations for sorting, so that equal obligations become adjacent.
int Compare(const ObligationPtr& a, const ObligationPtr& b) {
  if (a == b) return 0;
  const auto key = [](const Obligation& o) {
    return std::tuple(o.kind, o.atom, o.is_negated, o.is_judged, o.from, o.by, o.parts.size());
  };
  if (key(*a) != key(*b)) return key(*a) < key(*b) ? -1 : 1;
  for (std::size_t i = 0; i < a->parts.size(); ++i) {
    if (const int order = Compare(a->parts[i], b->parts[i]); order != 0) return order;
  }
  return 0;
}

// Whether `a` and `b` are both of `kind` (always or eventually), have the same operand, and their
// windows have begun. Then they differ only in the ends of their windows, so one implies the other.
bool OpenOverTheSame(const ObligationPtr& a, const ObligationPtr& b, Kind kind, SimTime now) {
  return a->kind == kind && b->kind == kind && a->is_judged && b->is_judged && a->from <= now &&
         b->from <= now && Compare(a->parts[0], b->parts[0]) == 0;
}

// Keeps only one of several parts that differ only in the ends of their windows. For `all`, this is
// the part that implies the others. For `any`, it is the part that the others imply. So the
// remaining obligation does not grow with the run.
void MergeWindows(Kind join, SimTime now, std::vector<ObligationPtr>& parts) {
  for (const Kind kind : {Kind::kEventually, Kind::kAlways}) {
    const bool keep_earlier = (join == Kind::kAll) == (kind == Kind::kEventually);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = parts.size(); j-- > i + 1;) {
        if (!OpenOverTheSame(parts[i], parts[j], kind, now)) continue;
        if ((parts[j]->by < parts[i]->by) == keep_earlier) parts[i] = parts[j];
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      }
    }
  }
}

ObligationPtr Join(Kind join, std::vector<ObligationPtr> given, SimTime now) {
  const Kind neutral = join == Kind::kAll ? Kind::kTrue : Kind::kFalse;
  std::vector<ObligationPtr> parts;
  for (ObligationPtr& part : given) {
    if (part->kind == neutral) continue;
    if (part->kind == Kind::kTrue || part->kind == Kind::kFalse) return part;
    if (part->kind == join) {
      parts.insert(parts.end(), part->parts.begin(), part->parts.end());
    } else {
      parts.push_back(std::move(part));
    }
  }
  base::Sort(parts, [](const auto& a, const auto& b) { return Compare(a, b) < 0; });
  parts.erase(std::unique(parts.begin(), parts.end(),
                          [](const auto& a, const auto& b) { return Compare(a, b) == 0; }),
              parts.end());
  MergeWindows(join, now, parts);
  if (parts.empty()) return Constant(join == Kind::kAll);
  if (parts.size() == 1) return parts.front();
  return std::make_shared<const Obligation>(Obligation{.kind = join, .parts = std::move(parts)});
}

Kind Dual(Kind kind) {
  switch (kind) {
    case Kind::kAll:
      return Kind::kAny;
    case Kind::kAny:
      return Kind::kAll;
    case Kind::kAlways:
      return Kind::kEventually;
    case Kind::kEventually:
      return Kind::kAlways;
    case Kind::kUntil:
      return Kind::kRelease;
    default:
      return kind;
  }
}

Kind KindOf(scenario::Formula::Kind kind) {
  switch (kind) {
    case scenario::Formula::Kind::kAll:
      return Kind::kAll;
    case scenario::Formula::Kind::kAny:
      return Kind::kAny;
    case scenario::Formula::Kind::kAlways:
      return Kind::kAlways;
    case scenario::Formula::Kind::kEventually:
      return Kind::kEventually;
    case scenario::Formula::Kind::kUntil:
      return Kind::kUntil;
    default:
      return Kind::kAtom;
  }
}

ObligationPtr Normal(const scenario::Formula& formula, bool is_negated,
                     const std::function<int(const scenario::Formula&)>& number) {
  if (formula.kind == scenario::Formula::Kind::kNot) {
    return Normal(formula.parts.at(0), !is_negated, number);
  }
  Obligation obligation;
  obligation.kind = is_negated ? Dual(KindOf(formula.kind)) : KindOf(formula.kind);
  if (obligation.kind == Kind::kAtom) {
    obligation.atom = number(formula);
    obligation.is_negated = is_negated;
  }
  obligation.from = base::FromSeconds(formula.from);
  obligation.by = formula.by ? base::FromSeconds(*formula.by) : kForever;
  for (const scenario::Formula& part : formula.parts) {
    obligation.parts.push_back(Normal(part, is_negated, number));
  }
  return std::make_shared<const Obligation>(std::move(obligation));
}

// Computes one step of the formula progression: the obligation that remains for the states after
// the current state.
class Progression {
 public:
  Progression(SimTime now, SimTime step, const std::function<bool(int)>& holds)
      : now_(now), next_(now + step), holds_(holds) {}

  ObligationPtr Of(const ObligationPtr& obligation) const {
    switch (obligation->kind) {
      case Kind::kFalse:
      case Kind::kTrue:
        return obligation;
      case Kind::kAtom:
        return Constant(holds_(obligation->atom) != obligation->is_negated);
      case Kind::kAll:
      case Kind::kAny: {
        std::vector<ObligationPtr> parts;
        for (const ObligationPtr& part : obligation->parts) parts.push_back(Of(part));
        return Join(obligation->kind, std::move(parts), now_);
      }
      default:
        return OfWindow(Judged(obligation));
    }
  }

 private:
  ObligationPtr Judged(const ObligationPtr& obligation) const {
    if (obligation->is_judged) return obligation;
    Obligation judged = *obligation;
    judged.is_judged = true;
    judged.from += now_;
    judged.by = judged.by >= kForever - now_ ? kForever : judged.by + now_;
    return std::make_shared<const Obligation>(std::move(judged));
  }

  // The rules are, with X for "in the next state":
  //   eventually  F a = a or X F a            until    a U b = b or (a and X (a U b))
  //   always      G a = a and X G a           release  a R b = b and (a or X (a R b))
  // If the next state is after the window, X F a and X (a U b) are false, and X G a and X (a R b)
  // are true. Before the window, "a" of F and "b" of U are false, and "a" of G and "b" of R are
  // true.
  ObligationPtr OfWindow(const ObligationPtr& window) const {
    const bool must_come = window->kind == Kind::kEventually || window->kind == Kind::kUntil;
    const bool is_open = window->from <= now_ && now_ <= window->by;
    const ObligationPtr here = is_open ? Of(window->parts.back()) : Constant(!must_come);
    ObligationPtr later = next_ <= window->by ? window : Constant(!must_come);
    if (window->kind == Kind::kUntil) {
      later = Join(Kind::kAll, {Of(window->parts.front()), later}, now_);
    } else if (window->kind == Kind::kRelease) {
      later = Join(Kind::kAny, {Of(window->parts.front()), later}, now_);
    }
    return Join(must_come ? Kind::kAny : Kind::kAll, {here, later}, now_);
  }

  const SimTime now_, next_;
  const std::function<bool(int)>& holds_;
};

bool AtTheEnd(const Obligation& obligation) {
  const auto holds = [](const ObligationPtr& part) { return AtTheEnd(*part); };
  switch (obligation.kind) {
    case Kind::kAll:
      return std::all_of(obligation.parts.begin(), obligation.parts.end(), holds);
    case Kind::kAny:
      return std::any_of(obligation.parts.begin(), obligation.parts.end(), holds);
    case Kind::kTrue:
    case Kind::kAlways:
    case Kind::kRelease:
      return true;
    default:
      return false;
  }
}

}  // namespace

Monitor::Monitor(const scenario::Formula& formula,
                 const std::function<int(const scenario::Formula& atom)>& number)
    : rest_(Normal(formula, false, number)) {}

void Monitor::Step(SimTime now, SimTime step, const std::function<bool(int atom)>& holds) {
  GSV_CHECK(step > SimTime(0));
  rest_ = Progression(now, step, holds).Of(rest_);
}

void Monitor::End() { rest_ = Constant(AtTheEnd(*rest_)); }

std::optional<bool> Monitor::verdict() const {
  if (rest_->kind == Kind::kTrue) return true;
  if (rest_->kind == Kind::kFalse) return false;
  return std::nullopt;
}

}  // namespace gsv::verdict
