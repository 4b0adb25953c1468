#include "gsv/broker/language/equality_terms.h"

namespace gsv::broker {
namespace {

void Collect(const Expression& constraint, const Node& node, std::vector<EqualityTerm>& terms) {
  if (node.op != Operator::kAnd && node.op != Operator::kEqual) return;
  const Node& left = constraint.nodes[node.left];
  const Node& right = constraint.nodes[node.right];
  if (node.op == Operator::kAnd) {
    Collect(constraint, left, terms);
    Collect(constraint, right, terms);
  } else if (left.op == Operator::kProperty && right.op == Operator::kLiteral) {
    terms.push_back({left.property, right.literal});
  } else if (left.op == Operator::kLiteral && right.op == Operator::kProperty) {
    terms.push_back({right.property, left.literal});
  }
}

}  // namespace

std::vector<EqualityTerm> EqualityTerms(const Expression& constraint) {
  std::vector<EqualityTerm> terms;
  Collect(constraint, constraint.root(), terms);
  return terms;
}

}  // namespace gsv::broker
