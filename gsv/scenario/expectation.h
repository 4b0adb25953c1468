// The expectations of a run, as formulas over its instants (docs/testing.md). A formula combines
// conditions on measured numbers with `all`, `any`, `not` and temporal operators.
//
// Semantics  linear temporal logic over the finite sequence of the run's steps, including the
//            initial state. Windows are in simulated time, relative to the instant at which a
//            formula is evaluated (metric temporal logic: R. Koymans, 1990; on finite traces: De
//            Giacomo and Vardi, 2013).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gsv/scenario/fault.h"

namespace gsv::scenario {

// A number that is measured at one instant of the run. `first` and `second` are members of
// Quantity.
struct Quantity {
  enum class Kind {
    kX,                // x of the origin of `first` in the world, m
    kY,                // y of the origin of `first` in the world, m
    kZ,                // height of `first`, m
    kDistanceToPoint,  // distance of `first` from (x, y), m in the plane
    kYawOff,           // angle between the yaw of `first` and `yaw`, rad, 0 to pi
    kSpeed,            // speed of `first`, m/s
    kTurning,          // turning rate of `first` about the vertical, rad/s, absolute value
    kTravelled,        // distance that `first` has travelled, m
    kDistance,         // horizontal distance between the origins of `first` and `second`, m
    // 1 if `first` touches `second`, else 0. If `second` is empty: anything except the ground.
    kContact,
    kSensor,  // a value that the sensor `second` of the robot `first` measures
    kEnded,   // 1 if the behaviour of `first` has finished or died, else 0
    kTime,    // simulated time, s
    // The time for which `first` did not move although it was commanded to move, s; 0 if it moves
    // or has no command (simulation/history/motion_history.h). If `first` is empty, the longest
    // such time of all robots.
    kStuck,
  };
  // Which number is taken from a reading with several values. kOne takes the element with the index
  // `value`.
  enum class Take { kMin, kMax, kMean, kOne };

  Kind kind = Kind::kTime;
  std::string first, second;     // see the comments of Kind; empty if the kind does not use them
  double x = 0, y = 0, yaw = 0;  // for kDistanceToPoint (m) and kYawOff (rad)
  Take take = Take::kMin;        // for kSensor
  int value = 0;                 // for Take::kOne: the index in the reading, from 0
};

// An atom, or an operator with its operands.
struct Formula {
  enum class Kind { kAtom, kNot, kAll, kAny, kAlways, kEventually, kUntil };

  Kind kind = Kind::kAtom;
  // Only for kAtom. The atom is true if the quantity is in [min, max]. If the quantity is not
  // available, the atom is false.
  Quantity quantity{};
  // For kStuck, a negative `min` means that Specification::stuck_after is the minimum.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  // The operands. kNot, kAlways and kEventually have one operand. kUntil has two operands: the
  // first must be true until the second is true. kAll and kAny have one operand or more.
  std::vector<Formula> parts{};
  // The time window of kAlways, kEventually and kUntil, in s after the instant at which the formula
  // is evaluated. If `by` is nullopt, the window ends with the run.
  double from = 0;             // start of the window
  std::optional<double> by{};  // end of the window
  SourcePlace source{};        // place of the formula in the scenario file
};

// A formula that a run must satisfy.
struct Expectation {
  std::string name;  // the name in reports
  std::string yaml;  // the YAML of the expectation, complete and on one line
  Formula formula;
  SourcePlace source{};  // place of the expectation in the scenario file

  friend bool operator==(const Expectation& a, const Expectation& b) { return a.yaml == b.yaml; }
};

}  // namespace gsv::scenario
