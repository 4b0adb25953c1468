// The operators of the constraint language on single values.
//
// Source   OMG Trading Object Service (formal/00-06-27), annex B.
// Threads  pure functions; any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <variant>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/value.h"

namespace gsv::broker {

// A value during an evaluation, or none. Strings are views and are never copied.
using Operand = std::variant<std::monostate, bool, std::int64_t, double, std::string_view>;
// The Operand of an expression that has no value.
inline constexpr std::monostate kNoOperand{};

Operand ToOperand(const ScalarValue& value);
// Returns kNoOperand for a sequence and for a value of type kOther.
Operand ToOperand(const Value& value);
// Returns the value of an integer or a real number, or nullopt for any other operand.
std::optional<long double> ToNumber(const Operand& operand);

// Returns the result of the comparison `op`, or kNoOperand if the operands cannot be compared.
Operand Compare(Operator op, const Operand& left, const Operand& right);
// Returns the result of +, -, * or /, or kNoOperand if an operand is not a number or the divisor is
// 0.
//
// It applies the numeric promotion of IDL's constant expressions and C. Two integers give an
// integer, and quotients are truncated. An integer and a real number give a real number. An integer
// result beyond 64 bits becomes a real number.
Operand Calculate(Operator op, const Operand& left, const Operand& right);
// Calculate() for two real numbers, without the check for a divisor of 0.
double RealResult(Operator op, double left, double right);
// Returns whether `sequence` has an element that is equal to `element`. Compares in order and stops
// at the first equal element. Returns kNoOperand if the sequence is null, or if one of the compared
// elements cannot be compared with `element`. `element` must not be kNoOperand.
Operand Contains(const Value::Sequence* sequence, const Operand& element);
// Returns whether `part` is contained in `whole`, or kNoOperand if one of them is not a text.
Operand Substring(const Operand& part, const Operand& whole);

// Calls `use` with the function object of the comparison `op`.
template <typename Use>
decltype(auto) WithComparison(Operator op, const Use& use) {
  switch (op) {
    case Operator::kEqual:
      return use(std::equal_to<>());
    case Operator::kNotEqual:
      return use(std::not_equal_to<>());
    case Operator::kLess:
      return use(std::less<>());
    case Operator::kLessEqual:
      return use(std::less_equal<>());
    case Operator::kGreater:
      return use(std::greater<>());
    default:
      return use(std::greater_equal<>());
  }
}

}  // namespace gsv::broker
