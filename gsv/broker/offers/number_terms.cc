#include "gsv/broker/offers/number_terms.h"

#include <optional>

#include "gsv/broker/offers/number_column.h"

namespace gsv::broker {
namespace {

std::optional<Operator> Mirrored(Operator op) {
  switch (op) {
    case Operator::kEqual:
    case Operator::kNotEqual:
      return op;
    case Operator::kLess:
      return Operator::kGreater;
    case Operator::kLessEqual:
      return Operator::kGreaterEqual;
    case Operator::kGreater:
      return Operator::kLess;
    case Operator::kGreaterEqual:
      return Operator::kLessEqual;
    default:
      return std::nullopt;
  }
}

std::optional<double> NumberOf(const ScalarValue& literal) {
  if (const auto* real = std::get_if<double>(&literal)) return *real;
  const auto* integer = std::get_if<std::int64_t>(&literal);
  return integer != nullptr ? ExactNumber(*integer) : std::nullopt;
}

void Collect(const Expression& constraint, const Node& node, NumberTerms& found) {
  if (node.op == Operator::kAnd) {
    Collect(constraint, constraint.nodes[node.left], found);
    Collect(constraint, constraint.nodes[node.right], found);
    return;
  }
  const auto mirrored = Mirrored(node.op);
  if (mirrored) {
    const Node& left = constraint.nodes[node.left];
    const Node& right = constraint.nodes[node.right];
    const bool property_first = left.op == Operator::kProperty;
    const Node& property = property_first ? left : right;
    const Node& literal = property_first ? right : left;
    if (property.op == Operator::kProperty && literal.op == Operator::kLiteral) {
      if (const auto number = NumberOf(literal.literal)) {
        found.terms.push_back({property.property, property_first ? node.op : *mirrored, *number});
        return;
      }
    }
  }
  found.complete = false;
}

}  // namespace

NumberTerms NumberTermsOf(const Expression& constraint) {
  NumberTerms found;
  Collect(constraint, constraint.root(), found);
  return found;
}

}  // namespace gsv::broker
