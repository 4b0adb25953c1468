// Finds the number terms of a constraint: comparisons of a property with a literal number that must
// all be TRUE for the constraint to be TRUE.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"

namespace gsv::broker {

struct NumberTerm {
  std::string property;
  Operator op;    // written with the property on its left
  double number;  // the exact value of the literal
};

struct NumberTerms {
  std::vector<NumberTerm> terms;  // those that `and` joins at the top level, in order
  bool complete = true;           // whether the constraint has no other terms
};

NumberTerms NumberTermsOf(const Expression& constraint);

}  // namespace gsv::broker
