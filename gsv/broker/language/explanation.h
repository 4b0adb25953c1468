// Why an offer matches a constraint, or does not: the terms that `and` joins, one by one.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/property.h"

namespace gsv::broker {

struct TermOutcome {
  enum class Result : std::uint8_t { kTrue, kFalse, kNoValue };
  std::string term;  // in the language, with all its parentheses
  Result result = Result::kNoValue;
  std::vector<std::string> missing{};  // properties that it names and the offer lacks
};

// In the order of the constraint, which matches when all are TRUE. Terms behind one that is not
// TRUE are looked at as well, though a query would not.
std::vector<TermOutcome> Explain(const Expression& constraint, const PropertySource& offer);

}  // namespace gsv::broker
