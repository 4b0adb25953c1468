// A constraint or preference, parsed: a tree of operators in a flat, post-ordered list.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/language/value.h"

namespace gsv::broker {

enum class Operator : std::uint8_t {
  kLiteral,
  kProperty,
  kExist,  // of a property
  kNot,
  kOr,
  kAnd,
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kIn,         // an expression is an element of a property of sequence type
  kSubstring,  // left is contained in right
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
};

// "==", "in", "~".
std::string_view Spelling(Operator op);

struct Node {
  Operator op = Operator::kLiteral;
  std::size_t position = 0;  // in the text, from 0
  ScalarValue literal{};     // kLiteral
  std::string property{};    // kProperty, kExist; of kIn the sequence
  std::size_t left = 0;      // the operand, of kNot and of every binary operator
  std::size_t right = 0;     // the second operand, of every binary operator but kIn
};

// Operands stand before their operators; the last node is the root. Never empty.
struct Expression {
  std::vector<Node> nodes;
  const Node& root() const { return nodes.back(); }
};

// A constraint: an expression, or the empty text, which is TRUE.
// Errors  kInvalidArgument with the position (counted from 1) at which the text is wrong.
base::Result<Expression> ParseConstraint(std::string_view text, const ExpressionLimits& limits);

struct Preference {
  enum class Kind : std::uint8_t { kFirst, kRandom, kMin, kMax, kWith };
  Kind kind = Kind::kFirst;
  Expression expression;  // of kMin, kMax and kWith
};

// A preference: "max e", "min e", "with e", "random", "first", or the empty text, which is first.
base::Result<Preference> ParsePreference(std::string_view text, const ExpressionLimits& limits);

}  // namespace gsv::broker
