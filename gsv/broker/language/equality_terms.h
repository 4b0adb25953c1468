// What a constraint demands of single properties: the terms `property == literal` that must all be
// TRUE for the whole to be.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"

namespace gsv::broker {

struct EqualityTerm {
  std::string property;
  ScalarValue value;
};

// Those joined by `and` from the root on, in their order.
std::vector<EqualityTerm> EqualityTerms(const Expression& constraint);

}  // namespace gsv::broker
