// What a constraint demands of single properties' numbers: the comparisons of a property with a
// literal number that must all be TRUE for the whole to be.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"

namespace gsv::broker {

struct NumberTerm {
  std::string property;
  Operator op;    // the property stands on its left
  double number;  // exactly the literal
};

struct NumberTerms {
  std::vector<NumberTerm> terms;  // joined by `and` from the root on, in their order
  bool complete = true;           // the constraint demands nothing else
};

NumberTerms NumberTermsOf(const Expression& constraint);

}  // namespace gsv::broker
