// Parses any text as a constraint and as a preference. It must be rejected, or the evaluator must
// agree with the naive one.
#include <cstdint>
#include <string>

#include "gsv/base/check.h"
#include "gsv/broker/language/equality_terms.h"
#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/language/expression.h"
#include "gsv/broker/testing/naive_evaluator.h"

using namespace gsv::broker;

namespace {

const PropertyList& Offer() {
  static const PropertyList offer({{"a", Value::Long(2)},
                                   {"b", Value::Double(0.5)},
                                   {"c", Value::String("it's")},
                                   {"d", Value::Strings({"x", "y"})},
                                   {"e", Value::Boolean(true)},
                                   {"f", Value::Char('x')},
                                   {"g", Value::SequenceOf(Scalar::kLong, {std::int64_t{2}})}});
  return offer;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto constraint = ParseConstraint(text, {})) {
    const bool matches = Matches(*constraint, Offer());
    GSV_CHECK(matches == NaivelyMatches(text, Offer()));
    for (const EqualityTerm& term : EqualityTerms(*constraint)) GSV_CHECK(!term.property.empty());
  }
  if (const auto preference = ParsePreference(text, {})) {
    if (!preference->expression.nodes.empty()) {
      (void)EvaluateNumber(preference->expression, Offer());
    }
  }
  return 0;
}
