#include "gsv/broker/language/expression.h"

namespace gsv::broker {

std::string_view Spelling(Operator op) {
  switch (op) {
    case Operator::kLiteral:
      return "literal";
    case Operator::kProperty:
      return "property";
    case Operator::kExist:
      return "exist";
    case Operator::kNot:
      return "not";
    case Operator::kOr:
      return "or";
    case Operator::kAnd:
      return "and";
    case Operator::kEqual:
      return "==";
    case Operator::kNotEqual:
      return "!=";
    case Operator::kLess:
      return "<";
    case Operator::kLessEqual:
      return "<=";
    case Operator::kGreater:
      return ">";
    case Operator::kGreaterEqual:
      return ">=";
    case Operator::kIn:
      return "in";
    case Operator::kSubstring:
      return "~";
    case Operator::kAdd:
      return "+";
    case Operator::kSubtract:
      return "-";
    case Operator::kMultiply:
      return "*";
    case Operator::kDivide:
      return "/";
  }
  return "";
}

}  // namespace gsv::broker
