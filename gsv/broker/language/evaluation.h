// Evaluates an expression for one offer.
//
// Operands are evaluated from left to right. `and` and `or` stop as soon as the result is known. An
// expression has no value if it needs a property that the offer lacks, if the type of a property
// does not fit its operator, or if it divides by zero. A constraint without a value is FALSE as a
// whole, so `not (speed > 3)` does not match an offer without a speed. An offer for which a
// preference has no value comes last.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B.
// Threads  pure functions; any thread.
#pragma once

#include <optional>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/property.h"

namespace gsv::broker {

bool Matches(const Expression& constraint, const PropertySource& offer);

// Returns the number by which `min` and `max` order offers, or nullopt if there is no value or the
// value is not a number. A long double represents every int64 and every double exactly, so integers
// and real numbers can be ordered together.
std::optional<long double> EvaluateNumber(const Expression& expression,
                                          const PropertySource& offer);

}  // namespace gsv::broker
