// The expectations of a run as formulas over its instants (docs/testing.md): conditions on measured
// numbers, combined with `all`, `any`, `not` and temporal operators.
//
// Semantics  linear temporal logic over the finite sequence of the run's steps, the initial state
//            included, with windows of simulated time relative to the instant at which a formula is
//            evaluated (metric temporal logic: R. Koymans, 1990; on finite traces: De Giacomo and
//            Vardi, 2013).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gsv/scenario/fault.h"

namespace gsv::scenario {

// A number of the run at one instant.
struct Quantity {
  enum class Kind {
    kX,
    kY,
    kZ,                // of `first`, m
    kDistanceToPoint,  // of `first` from (x, y), m in the plane
    kYawOff,           // of `first` from `yaw`, rad, 0 to pi
    kSpeed,            // of `first`, m/s
    kTurning,          // of `first` about the vertical, rad/s, absolute value
    kTravelled,        // by `first`, m
    kDistance,         // horizontal distance between the origins of `first` and `second`, m
    kContact,          // 1 when `first` touches `second` (empty: anything but the ground), else 0
    kSensor,           // a value of `first`'s sensor `second`
    kEnded,            // 1 when `first`'s behaviour has finished or died, else 0
    kTime,             // s
  };
  enum class Take { kMin, kMax, kMean, kOne };  // of a reading's values

  Kind kind = Kind::kTime;
  std::string first, second;
  double x = 0, y = 0, yaw = 0;
  Take take = Take::kMin;
  int value = 0;  // which, for kOne
};

struct Formula {
  enum class Kind { kAtom, kNot, kAll, kAny, kAlways, kEventually, kUntil };

  Kind kind = Kind::kAtom;
  // kAtom: the quantity lies in [min, max]. A quantity that is not available lies in no
  // interval.
  Quantity quantity{};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  // kUntil: the first part holds until the second does. kNot, kAlways, kEventually: one part.
  std::vector<Formula> parts{};
  double from = 0;             // s after the instant of evaluation
  std::optional<double> by{};  // default: the end of the run
  SourcePlace source{};
};

struct Expectation {
  std::string name;  // in reports
  std::string yaml;  // the YAML of the scenario on one line, complete
  Formula formula;
  SourcePlace source{};

  friend bool operator==(const Expectation& a, const Expectation& b) { return a.yaml == b.yaml; }
};

}  // namespace gsv::scenario
