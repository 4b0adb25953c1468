#include "gsv/broker/language/evaluation.h"

#include <cmath>
#include <variant>

#include "gsv/broker/language/operand.h"

namespace gsv::broker {
namespace {

class Evaluator {
 public:
  Evaluator(const Expression& expression, const PropertySource& offer)
      : nodes_(expression.nodes), offer_(offer) {}

  Operand Evaluate() const { return Evaluate(nodes_.back()); }

 private:
  Operand Evaluate(const Node& node) const {
    switch (node.op) {
      case Operator::kLiteral:
        return ToOperand(node.literal);
      case Operator::kProperty: {
        const Value* value = offer_.Find(node.property);
        return value != nullptr ? ToOperand(*value) : kNoOperand;
      }
      case Operator::kExist:
        return offer_.Find(node.property) != nullptr;
      case Operator::kNot:
        return Negate(Left(node));
      case Operator::kOr:
        return Decide(node, true);
      case Operator::kAnd:
        return Decide(node, false);
      case Operator::kIn:
        return EvaluateIn(node);
      case Operator::kSubstring:
        return Substring(Left(node), Right(node));
      case Operator::kAdd:
      case Operator::kSubtract:
      case Operator::kMultiply:
      case Operator::kDivide:
        return Calculate(node.op, Left(node), Right(node));
      default:
        return Compare(node.op, Left(node), Right(node));
    }
  }

  Operand Left(const Node& node) const { return Evaluate(nodes_[node.left]); }
  Operand Right(const Node& node) const { return Evaluate(nodes_[node.right]); }

  static Operand Negate(const Operand& operand) {
    const auto* truth = std::get_if<bool>(&operand);
    if (truth == nullptr) return kNoOperand;
    return !*truth;
  }

  // Evaluates `and` or `or`. If the left operand is `deciding` (TRUE for `or`, FALSE for `and`), it
  // is the result, and the right operand is not evaluated.
  Operand Decide(const Node& node, bool deciding) const {
    const Operand left = Left(node);
    const auto* truth = std::get_if<bool>(&left);
    if (truth == nullptr) return kNoOperand;
    if (*truth == deciding) return deciding;
    const Operand right = Right(node);
    return std::holds_alternative<bool>(right) ? right : kNoOperand;
  }

  Operand EvaluateIn(const Node& node) const {
    const Operand element = Left(node);
    if (std::holds_alternative<std::monostate>(element)) return kNoOperand;
    const Value* sequence = offer_.Find(node.property);
    return sequence != nullptr ? Contains(sequence->AsSequence(), element) : kNoOperand;
  }

  const std::vector<Node>& nodes_;
  const PropertySource& offer_;
};

}  // namespace

bool Matches(const Expression& constraint, const PropertySource& offer) {
  const Operand result = Evaluator(constraint, offer).Evaluate();
  const auto* truth = std::get_if<bool>(&result);
  return truth != nullptr && *truth;
}

std::optional<long double> EvaluateNumber(const Expression& expression,
                                          const PropertySource& offer) {
  const auto number = ToNumber(Evaluator(expression, offer).Evaluate());
  return number && std::isnan(*number) ? std::nullopt : number;
}

}  // namespace gsv::broker
