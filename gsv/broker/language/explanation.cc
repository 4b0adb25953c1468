#include "gsv/broker/language/explanation.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "gsv/broker/language/evaluation.h"

namespace gsv::broker {
namespace {

std::string TextOf(const ScalarValue& literal) {
  if (const auto* truth = std::get_if<bool>(&literal)) return *truth ? "TRUE" : "FALSE";
  if (const auto* integer = std::get_if<std::int64_t>(&literal)) return fmt::format("{}", *integer);
  if (const auto* real = std::get_if<double>(&literal)) return fmt::format("{}", *real);
  std::string text = "'";
  for (const char character : std::get<std::string>(literal)) {
    if (character == '\'' || character == '\\') text += '\\';
    text += character;
  }
  return text + "'";
}

bool IsLeaf(const Node& node) {
  return node.op == Operator::kLiteral || node.op == Operator::kProperty ||
         node.op == Operator::kExist;
}

std::string TextOf(const Expression& expression, std::size_t index) {
  const Node& node = expression.nodes[index];
  const auto operand = [&](std::size_t at) {
    const std::string text = TextOf(expression, at);
    return IsLeaf(expression.nodes[at]) ? text : "(" + text + ")";
  };
  switch (node.op) {
    case Operator::kLiteral:
      return TextOf(node.literal);
    case Operator::kProperty:
      return node.property;
    case Operator::kExist:
      return "exist " + node.property;
    case Operator::kNot:
      return "not " + operand(node.left);
    case Operator::kIn:
      return operand(node.left) + " in " + node.property;
    default:
      return fmt::format("{} {} {}", operand(node.left), Spelling(node.op), operand(node.right));
  }
}

void CollectMissing(const Expression& expression, std::size_t index, const PropertySource& offer,
                    std::vector<std::string>& missing) {
  const Node& node = expression.nodes[index];
  const bool names = node.op == Operator::kProperty || node.op == Operator::kIn;
  if (names && offer.Find(node.property) == nullptr &&
      std::find(missing.begin(), missing.end(), node.property) == missing.end()) {
    missing.push_back(node.property);
  }
  if (IsLeaf(node)) return;
  CollectMissing(expression, node.left, offer, missing);
  if (node.op != Operator::kNot && node.op != Operator::kIn) {
    CollectMissing(expression, node.right, offer, missing);
  }
}

TermOutcome OutcomeOf(const Expression& constraint, std::size_t index,
                      const PropertySource& offer) {
  TermOutcome outcome{.term = TextOf(constraint, index)};
  // The nodes from the first to `index` are an expression for the term: its operands come before
  // `index`, and the last node of an expression is its root.
  Expression term{{constraint.nodes.begin(),
                   constraint.nodes.begin() + static_cast<std::ptrdiff_t>(index) + 1}};
  if (Matches(term, offer)) {
    outcome.result = TermOutcome::Result::kTrue;
    return outcome;
  }
  term.nodes.push_back({.op = Operator::kNot, .left = index});
  if (Matches(term, offer)) {
    outcome.result = TermOutcome::Result::kFalse;
  } else {
    CollectMissing(constraint, index, offer, outcome.missing);
  }
  return outcome;
}

void Collect(const Expression& constraint, std::size_t index, const PropertySource& offer,
             std::vector<TermOutcome>& outcomes) {
  const Node& node = constraint.nodes[index];
  if (node.op != Operator::kAnd) {
    outcomes.push_back(OutcomeOf(constraint, index, offer));
    return;
  }
  Collect(constraint, node.left, offer, outcomes);
  Collect(constraint, node.right, offer, outcomes);
}

}  // namespace

std::vector<TermOutcome> Explain(const Expression& constraint, const PropertySource& offer) {
  std::vector<TermOutcome> outcomes;
  Collect(constraint, constraint.nodes.size() - 1, offer, outcomes);
  return outcomes;
}

}  // namespace gsv::broker
