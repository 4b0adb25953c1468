// The value of an expression for one offer.
//
// Operands are evaluated from left to right, and `and` and `or` only as far as needed. An
// expression has no value when it needs a property that the offer lacks, or one whose type does
// not fit its operator, or divides by zero: a constraint is then FALSE as a whole (so that
// `not (speed > 3)` does not match an offer without a speed), and the offer comes last in the
// order of a preference.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B.
// Threads  pure; any number at once.
#pragma once

#include <optional>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/property.h"

namespace gsv::broker {

bool Matches(const Expression& constraint, const PropertySource& offer);

// The number that `min` and `max` order by. long double holds every int64 and double exactly, so
// that mixed numbers have one order. Nothing when there is no value, or it is not a number.
std::optional<long double> EvaluateNumber(const Expression& expression,
                                          const PropertySource& offer);

}  // namespace gsv::broker
