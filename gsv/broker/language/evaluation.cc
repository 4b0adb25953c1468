#include "gsv/broker/language/evaluation.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace gsv::broker {
namespace {

// Strings are views and are never copied.
using Operand = std::variant<std::monostate, bool, std::int64_t, double, std::string_view>;

constexpr std::monostate kNoValue{};

Operand ToOperand(const ScalarValue& value) {
  return std::visit(
      [](const auto& content) -> Operand {
        if constexpr (std::is_same_v<std::decay_t<decltype(content)>, std::string>) {
          return std::string_view(content);
        } else {
          return content;
        }
      },
      value);
}

Operand ToOperand(const Value& value) {
  if (const auto* number = value.As<std::int64_t>()) return *number;
  if (const auto* number = value.As<double>()) return *number;
  if (const auto* text = value.As<std::string>()) return std::string_view(*text);
  if (const auto* truth = value.As<bool>()) return *truth;
  return kNoValue;
}

std::optional<long double> ToNumber(const Operand& operand) {
  if (const auto* integer = std::get_if<std::int64_t>(&operand)) return *integer;
  if (const auto* real = std::get_if<double>(&operand)) return *real;
  return std::nullopt;
}

template <typename T>
bool Holds(Operator op, const T& left, const T& right) {
  switch (op) {
    case Operator::kEqual:
      return left == right;
    case Operator::kNotEqual:
      return left != right;
    case Operator::kLess:
      return left < right;
    case Operator::kLessEqual:
      return left <= right;
    case Operator::kGreater:
      return left > right;
    default:
      return left >= right;
  }
}

Operand Compare(Operator op, const Operand& left, const Operand& right) {
  const auto a = ToNumber(left);
  const auto b = ToNumber(right);
  if (a && b) return Holds(op, *a, *b);
  if (left.index() != right.index()) return kNoValue;
  if (const auto* text = std::get_if<std::string_view>(&left)) {
    return Holds(op, *text, std::get<std::string_view>(right));
  }
  if (const auto* truth = std::get_if<bool>(&left)) {
    return Holds(op, *truth, std::get<bool>(right));
  }
  return kNoValue;
}

double RealResult(Operator op, double a, double b) {
  switch (op) {
    case Operator::kAdd:
      return a + b;
    case Operator::kSubtract:
      return a - b;
    case Operator::kMultiply:
      return a * b;
    default:
      return a / b;
  }
}

// Computes the exact result. Returns nullopt on overflow.
std::optional<std::int64_t> IntegerResult(Operator op, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  switch (op) {
    case Operator::kAdd:
      return __builtin_add_overflow(a, b, &result) ? std::nullopt : std::optional(result);
    case Operator::kSubtract:
      return __builtin_sub_overflow(a, b, &result) ? std::nullopt : std::optional(result);
    case Operator::kMultiply:
      return __builtin_mul_overflow(a, b, &result) ? std::nullopt : std::optional(result);
    default:
      return b == -1 ? IntegerResult(Operator::kSubtract, 0, a) : a / b;
  }
}

// Applies the numeric promotion of IDL's constant expressions and C. Two integers give an integer,
// and quotients are truncated. An integer and a real number give a real number. An integer result
// beyond 64 bits becomes a real number.
Operand Calculate(Operator op, const Operand& left, const Operand& right) {
  const auto a = ToNumber(left);
  const auto b = ToNumber(right);
  if (!a || !b || (op == Operator::kDivide && *b == 0)) return kNoValue;
  const auto* m = std::get_if<std::int64_t>(&left);
  const auto* n = std::get_if<std::int64_t>(&right);
  if (m != nullptr && n != nullptr) {
    if (const auto exact = IntegerResult(op, *m, *n)) return *exact;
  }
  return RealResult(op, static_cast<double>(*a), static_cast<double>(*b));
}

Operand Contains(const Value* sequence, const Operand& element) {
  if (sequence == nullptr || sequence->AsSequence() == nullptr) return kNoValue;
  for (const ScalarValue& candidate : *sequence->AsSequence()) {
    const Operand equal = Compare(Operator::kEqual, element, ToOperand(candidate));
    if (!std::holds_alternative<bool>(equal)) return kNoValue;
    if (std::get<bool>(equal)) return true;
  }
  return false;
}

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
        return value != nullptr ? ToOperand(*value) : kNoValue;
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
    if (truth == nullptr) return kNoValue;
    return !*truth;
  }

  // Evaluates `and` or `or`. A left operand that is TRUE decides `or`, and one that is FALSE
  // decides `and`.
  Operand Decide(const Node& node, bool deciding) const {
    const Operand left = Left(node);
    const auto* truth = std::get_if<bool>(&left);
    if (truth == nullptr) return kNoValue;
    if (*truth == deciding) return deciding;
    const Operand right = Right(node);
    return std::holds_alternative<bool>(right) ? right : kNoValue;
  }

  Operand EvaluateIn(const Node& node) const {
    const Operand element = Left(node);
    if (std::holds_alternative<std::monostate>(element)) return kNoValue;
    return Contains(offer_.Find(node.property), element);
  }

  static Operand Substring(const Operand& part, const Operand& whole) {
    const auto* needle = std::get_if<std::string_view>(&part);
    const auto* text = std::get_if<std::string_view>(&whole);
    if (needle == nullptr || text == nullptr) return kNoValue;
    return text->find(*needle) != std::string_view::npos;
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
