// Finds the equality terms of a constraint: terms `property == literal` that must all be TRUE for
// the constraint to be TRUE.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"

namespace gsv::broker {

struct EqualityTerm {
  std::string property;
  ScalarValue value;  // the literal
};

// Returns the equality terms that `and` joins at the top level of the constraint, in their order.
std::vector<EqualityTerm> EqualityTerms(const Expression& constraint);

}  // namespace gsv::broker
