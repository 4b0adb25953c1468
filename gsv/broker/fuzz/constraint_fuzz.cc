// Fuzz target: parses the input as a constraint and as a preference. If the input is valid, the
// evaluators for single offers and for columns must return the same results as a naive evaluator.
#include <cstdint>
#include <memory>
#include <string>

#include "gsv/base/check.h"
#include "gsv/broker/language/equality_terms.h"
#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/language/expression.h"
#include "gsv/broker/offers/column_constraint.h"
#include "gsv/broker/testing/naive_evaluator.h"

using namespace gsv::broker;

namespace {

const PropertyList& TestedOffer() {
  static const PropertyList offer({{"a", Value::Long(2)},
                                   {"b", Value::Double(0.5)},
                                   {"c", Value::String("it's")},
                                   {"d", Value::Strings({"x", "y"})},
                                   {"e", Value::Boolean(true)},
                                   {"f", Value::Char('x')},
                                   {"g", Value::SequenceOf(Scalar::kLong, {std::int64_t{2}})}});
  return offer;
}

bool MatchesColumns(const Expression& expression) {
  const Offers offers = {std::make_shared<const Offer>(Offer{.properties = TestedOffer()})};
  const ColumnConstraint constraint(expression);
  ColumnConstraint::Columns columns;
  for (const std::string& property : constraint.properties()) {
    columns.push_back(std::make_shared<const PropertyColumn>(offers, property));
  }
  return constraint.Choose(columns, 1).front() == Choice::kYes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto constraint = ParseConstraint(text, {})) {
    const bool matches = Matches(*constraint, TestedOffer());
    GSV_CHECK(matches == NaivelyMatches(text, TestedOffer()));
    GSV_CHECK(matches == MatchesColumns(*constraint));
    for (const EqualityTerm& term : EqualityTerms(*constraint)) GSV_CHECK(!term.property.empty());
  }
  if (const auto preference = ParsePreference(text, {})) {
    if (!preference->expression.nodes.empty()) {
      (void)EvaluateNumber(preference->expression, TestedOffer());
    }
  }
  return 0;
}
