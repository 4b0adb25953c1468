#include "gsv/broker/language/operand.h"

namespace gsv::broker {
namespace {

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

}  // namespace

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
  if (const auto number = value.AsInteger()) return *number;
  if (const auto number = value.AsReal()) return *number;
  if (const auto text = value.AsText()) return *text;
  if (const auto truth = value.AsBoolean()) return *truth;
  return kNoOperand;
}

std::optional<long double> ToNumber(const Operand& operand) {
  if (const auto* integer = std::get_if<std::int64_t>(&operand)) return *integer;
  if (const auto* real = std::get_if<double>(&operand)) return *real;
  return std::nullopt;
}

Operand Compare(Operator op, const Operand& left, const Operand& right) {
  const auto a = ToNumber(left);
  const auto b = ToNumber(right);
  return WithComparison(op, [&](const auto& holds) -> Operand {
    if (a && b) return holds(*a, *b);
    if (left.index() != right.index()) return kNoOperand;
    if (const auto* text = std::get_if<std::string_view>(&left)) {
      return holds(*text, std::get<std::string_view>(right));
    }
    if (const auto* truth = std::get_if<bool>(&left)) return holds(*truth, std::get<bool>(right));
    return kNoOperand;
  });
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

Operand Calculate(Operator op, const Operand& left, const Operand& right) {
  const auto a = ToNumber(left);
  const auto b = ToNumber(right);
  if (!a || !b || (op == Operator::kDivide && *b == 0)) return kNoOperand;
  const auto* m = std::get_if<std::int64_t>(&left);
  const auto* n = std::get_if<std::int64_t>(&right);
  if (m != nullptr && n != nullptr) {
    if (const auto exact = IntegerResult(op, *m, *n)) return *exact;
  }
  return RealResult(op, static_cast<double>(*a), static_cast<double>(*b));
}

Operand Contains(const Value::Sequence* sequence, const Operand& element) {
  if (sequence == nullptr) return kNoOperand;
  for (const ScalarValue& candidate : *sequence) {
    const Operand equal = Compare(Operator::kEqual, element, ToOperand(candidate));
    if (!std::holds_alternative<bool>(equal)) return kNoOperand;
    if (std::get<bool>(equal)) return true;
  }
  return false;
}

Operand Substring(const Operand& part, const Operand& whole) {
  const auto* needle = std::get_if<std::string_view>(&part);
  const auto* text = std::get_if<std::string_view>(&whole);
  if (needle == nullptr || text == nullptr) return kNoOperand;
  return text->find(*needle) != std::string_view::npos;
}

}  // namespace gsv::broker
