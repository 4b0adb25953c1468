// A parsed constraint or preference. It is a tree of operators in a flat list, in which operands
// come before their operators.
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
  kExist,  // whether an offer has a property
  kNot,
  kOr,
  kAnd,
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kIn,         // whether an expression is an element of a property of sequence type
  kSubstring,  // whether the left operand is contained in the right one
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
};

// Returns the operator as it is written, such as "==", "in" or "~".
std::string_view Spelling(Operator op);

struct Node {
  Operator op = Operator::kLiteral;
  std::size_t position = 0;  // position in the text, from 0
  ScalarValue literal{};     // for kLiteral
  // name of the property for kProperty and kExist; for kIn, the property of sequence type
  std::string property{};
  // index of the operand of kNot, or of the first operand of a binary operator
  std::size_t left = 0;
  std::size_t right = 0;  // index of the second operand, for binary operators except kIn
};

// The nodes of an expression. Operands come before their operators, and the last node is the root.
// Never empty.
struct Expression {
  std::vector<Node> nodes;
  const Node& root() const { return nodes.back(); }
};

// Parses a constraint. The empty text is a constraint that is TRUE for every offer. Returns
// kInvalidArgument with the position of the error in the text, counted from 1.
base::Result<Expression> ParseConstraint(std::string_view text, const ExpressionLimits& limits);

struct Preference {
  enum class Kind : std::uint8_t { kFirst, kRandom, kMin, kMax, kWith };
  Kind kind = Kind::kFirst;  // the word with which the preference begins
  Expression expression;     // for kMin, kMax and kWith
};

// Parses a preference: "max e", "min e", "with e", "random", "first", or the empty text, which
// means "first".
base::Result<Preference> ParsePreference(std::string_view text, const ExpressionLimits& limits);

}  // namespace gsv::broker
