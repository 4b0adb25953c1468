#include "gsv/broker/language/type_check.h"

#include <string>
#include <vector>

namespace gsv::broker {
namespace {

// A literal of one character, such as 'a', is a string or a char. So its kind is kCharOrString.
enum class Kind { kUnknown, kBoolean, kNumber, kString, kChar, kCharOrString, kSequence, kOther };

Kind KindOf(Scalar scalar) {
  switch (scalar) {
    case Scalar::kBoolean:
      return Kind::kBoolean;
    case Scalar::kChar:
      return Kind::kChar;
    case Scalar::kString:
      return Kind::kString;
    case Scalar::kOther:
      return Kind::kOther;
    default:
      return Kind::kNumber;
  }
}

Kind KindOf(const ScalarValue& literal) {
  if (std::holds_alternative<bool>(literal)) return Kind::kBoolean;
  const auto* text = std::get_if<std::string>(&literal);
  if (text == nullptr) return Kind::kNumber;
  return text->size() == 1 ? Kind::kCharOrString : Kind::kString;
}

const char* Name(Kind kind) {
  switch (kind) {
    case Kind::kBoolean:
      return "a boolean";
    case Kind::kNumber:
      return "a number";
    case Kind::kString:
    case Kind::kCharOrString:
      return "a string";
    case Kind::kChar:
      return "a char";
    case Kind::kSequence:
      return "a sequence";
    case Kind::kOther:
      return "a value of a type that only 'exist' supports";
    case Kind::kUnknown:
      break;
  }
  return "unknown";
}

bool IsSimple(Kind kind) { return kind != Kind::kSequence && kind != Kind::kOther; }

bool MayBe(Kind kind, Kind wanted) {
  if (kind == Kind::kUnknown || kind == wanted) return true;
  return kind == Kind::kCharOrString && (wanted == Kind::kString || wanted == Kind::kChar);
}

bool MayCompare(Kind left, Kind right) {
  if (!IsSimple(left) || !IsSimple(right)) return false;
  return right == Kind::kUnknown || MayBe(left, right) || MayBe(right, left);
}

class Checker {
 public:
  Checker(const Expression& expression, const DeclaredTypes& types)
      : expression_(expression), types_(types) {}

  // Returns the kind of the whole expression. Operands of unknown kind are accepted.
  base::Result<Kind> Check() {
    for (const Node& node : expression_.nodes) {
      auto kind = CheckNode(node);
      if (!kind) return kind;
      kinds_.push_back(*kind);
    }
    return kinds_.back();
  }

 private:
  base::Result<Kind> CheckNode(const Node& node) const {
    switch (node.op) {
      case Operator::kLiteral:
        return KindOf(node.literal);
      case Operator::kProperty:
        return PropertyKind(node.property);
      case Operator::kExist:
        return Kind::kBoolean;
      case Operator::kNot:
      case Operator::kOr:
      case Operator::kAnd:
        return Operands(node, Kind::kBoolean, Kind::kBoolean);
      case Operator::kSubstring:
        return Operands(node, Kind::kString, Kind::kBoolean);
      case Operator::kAdd:
      case Operator::kSubtract:
      case Operator::kMultiply:
      case Operator::kDivide:
        return Operands(node, Kind::kNumber, Kind::kNumber);
      case Operator::kIn:
        return Membership(node);
      default:
        return Comparison(node);
    }
  }

  Kind PropertyKind(std::string_view name) const {
    const std::optional<PropertyType> type = types_(name);
    if (!type) return Kind::kUnknown;
    return type->sequence ? Kind::kSequence : KindOf(type->scalar);
  }

  base::Result<Kind> Operands(const Node& node, Kind wanted, Kind result) const {
    if (!MayBe(kinds_[node.left], wanted)) return Refuse(node, wanted, kinds_[node.left]);
    const bool binary = node.op != Operator::kNot;
    if (binary && !MayBe(kinds_[node.right], wanted)) {
      return Refuse(node, wanted, kinds_[node.right]);
    }
    return result;
  }

  base::Result<Kind> Comparison(const Node& node) const {
    const Kind left = kinds_[node.left];
    const Kind right = kinds_[node.right];
    if (MayCompare(left, right)) return Kind::kBoolean;
    return Refuse(node, std::string("its operands are ") + Name(left) + " and " + Name(right) +
                            ", which cannot be compared");
  }

  base::Result<Kind> Membership(const Node& node) const {
    const Kind element = kinds_[node.left];
    const std::optional<PropertyType> type = types_(node.property);
    if (type && !type->sequence) {
      return Refuse(node, "the property " + node.property + " is " + type->Spelling() +
                              ", not a sequence of a simple type");
    }
    const Kind wanted = type ? KindOf(type->scalar) : Kind::kUnknown;
    if (!MayCompare(element, wanted)) {
      if (!type) return Refuse(node, std::string("no sequence can contain ") + Name(element));
      return Refuse(node, "the property " + node.property + " is " + type->Spelling() +
                              ", which cannot contain " + Name(element));
    }
    return Kind::kBoolean;
  }

  static base::Result<Kind> Refuse(const Node& node, Kind wanted, Kind found) {
    return Refuse(node,
                  std::string("it needs ") + Name(wanted) + ", and its operand is " + Name(found));
  }

  static base::Result<Kind> Refuse(const Node& node, const std::string& why) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "'" + std::string(Spelling(node.op)) + "': " + why,
                      "character " + std::to_string(node.position + 1));
  }

  const Expression& expression_;
  const DeclaredTypes& types_;
  std::vector<Kind> kinds_;
};

base::Status CheckIs(const Expression& expression, Kind wanted, const char* what,
                     const DeclaredTypes& types) {
  const auto kind = Checker(expression, types).Check();
  if (!kind) return base::Fail(kind.error());
  if (MayBe(*kind, wanted)) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    std::string(what) + " must be " + Name(wanted) + ", not " + Name(*kind),
                    "character " + std::to_string(expression.root().position + 1));
}

}  // namespace

base::Status CheckConstraintTypes(const Expression& constraint, const DeclaredTypes& types) {
  return CheckIs(constraint, Kind::kBoolean, "a constraint", types);
}

base::Status CheckPreferenceTypes(const Preference& preference, const DeclaredTypes& types) {
  switch (preference.kind) {
    case Preference::Kind::kMin:
      return CheckIs(preference.expression, Kind::kNumber, "the expression after 'min'", types);
    case Preference::Kind::kMax:
      return CheckIs(preference.expression, Kind::kNumber, "the expression after 'max'", types);
    case Preference::Kind::kWith:
      return CheckIs(preference.expression, Kind::kBoolean, "the expression after 'with'", types);
    default:
      return {};
  }
}

}  // namespace gsv::broker
