// Explains why an offer matches a constraint or not. It gives the value of each term that `and`
// joins.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/property.h"

namespace gsv::broker {

struct TermOutcome {
  enum class Result : std::uint8_t { kTrue, kFalse, kNoValue };
  std::string term;                    // the term as text, with all its parentheses
  Result result = Result::kNoValue;    // value of the term for the offer
  std::vector<std::string> missing{};  // for kNoValue: properties that the offer lacks
};

// Returns the terms in the order of the constraint. The constraint matches if all terms are TRUE.
// Terms after a term that is not TRUE are evaluated as well, although a query would stop there.
std::vector<TermOutcome> Explain(const Expression& constraint, const PropertySource& offer);

}  // namespace gsv::broker
