#include "gsv/formats/xacro/evaluation.h"

#include <algorithm>

#include "gsv/formats/xacro/expression_parser.h"
#include "gsv/formats/xacro/operators.h"

namespace gsv::formats::xacro {
namespace {

using Kind = Expression::Kind;

constexpr std::size_t kMaxValues = 20'000;  // maximum number of values in a list, including the
                                            // values in its items

// Counts the value and the values inside it, and subtracts the number from `room`. Returns false if
// there are more than `room`. Lists can share items, so even a small expression can produce very
// many values.
bool Fits(const Value& value, std::size_t& room) {
  if (room == 0) return false;
  --room;
  if (const List* items = value.items()) {
    return std::all_of(items->begin(), items->end(),
                       [&](const Value& item) { return Fits(item, room); });
  }
  if (const Dictionary* entries = value.dictionary()) {
    return std::all_of(entries->begin(), entries->end(), [&](const auto& entry) {
      return Fits(entry.first, room) && Fits(entry.second, room);
    });
  }
  return true;
}

class Evaluator {
 public:
  explicit Evaluator(const EvaluationContext& context) : context_(context) {}

  base::Result<Value> Of(const Expression& node) {
    switch (node.kind) {
      case Kind::kLiteral:
        return node.value;
      case Kind::kName:
        return Name(node.text);
      case Kind::kMember:
        return MemberOf(node);
      case Kind::kIndex:
      case Kind::kSlice:
        return Element(node);
      case Kind::kCall:
        return Call(node);
      case Kind::kList:
      case Kind::kTuple:
        return Items(node);
      case Kind::kDictionary:
        return Entries(node);
      case Kind::kUnary:
        return Unary(node);
      case Kind::kBinary:
        return Binary(node);
      case Kind::kCompare:
        return Comparison(node);
      case Kind::kAnd:
      case Kind::kOr:
        return Logic(node);
      case Kind::kTernary:
        break;
    }
    const auto condition = Of(*node.parts[0]);
    if (!condition) return condition;
    return Of(*node.parts[IsTrue(*condition) ? 1 : 2]);
  }

 private:
  static base::Failure<base::Error> Refuse(const std::string& why) {
    return base::Fail(base::ErrorCode::kBadModel, why);
  }

  base::Result<Value> Name(const std::string& name) {
    auto property = context_.property(name);
    if (!property) return base::Fail(property.error());
    if (*property) return **property;
    if (auto constant = Constant(name)) return *constant;
    if (IsFunction(name)) return Refuse("the function " + name + " needs parentheses");
    return Refuse("\"" + name + "\" is not defined");
  }

  // Whether the node is a module, such as `math` in `math.pi`. A module is not a value.
  static bool IsModule(const Expression& node) {
    return node.kind == Kind::kName &&
           (node.text == "math" || node.text == "xacro" || node.text == "python");
  }

  base::Result<Value> MemberOf(const Expression& node) {
    if (IsModule(*node.parts[0])) {
      const auto shadow = context_.property(node.parts[0]->text);
      if (shadow && !*shadow) {
        if (auto constant = Constant(node.text)) return *constant;
        return Refuse("\"" + node.parts[0]->text + "." + node.text + "\" is not supported");
      }
    }
    const auto of = Of(*node.parts[0]);
    return of ? Member(*of, node.text) : of;
  }

  base::Result<Value> Element(const Expression& node) {
    const auto of = Of(*node.parts[0]);
    if (!of) return of;
    Value ends[2];
    for (std::size_t i = 1; i < node.parts.size(); ++i) {
      if (node.parts[i] == nullptr) continue;
      const auto end = Of(*node.parts[i]);
      if (!end) return end;
      ends[i - 1] = *end;
    }
    return node.kind == Kind::kIndex ? Index(*of, ends[0]) : Slice(*of, ends[0], ends[1]);
  }

  base::Result<std::vector<Value>> All(const Expression& node, std::size_t first) {
    std::vector<Value> values;
    for (std::size_t i = first; i < node.parts.size(); ++i) {
      auto value = Of(*node.parts[i]);
      if (!value) return base::Fail(value.error());
      values.push_back(*std::move(value));
    }
    return values;
  }

  base::Result<Value> Items(const Expression& node) {
    auto items = All(node, 0);
    if (!items) return base::Fail(items.error());
    return node.kind == Kind::kList ? MakeList(*std::move(items)) : MakeTuple(*std::move(items));
  }

  base::Result<Value> Entries(const Expression& node) {
    const auto parts = All(node, 0);
    if (!parts) return base::Fail(parts.error());
    Dictionary entries;
    for (std::size_t i = 0; i + 1 < parts->size(); i += 2) {
      entries.emplace_back((*parts)[i], (*parts)[i + 1]);
    }
    return MakeDictionary(std::move(entries));
  }

  base::Result<Value> Call(const Expression& node) {
    const Expression& function = *node.parts[0];
    auto arguments = All(node, 1);
    if (!arguments) return base::Fail(arguments.error());
    if (function.kind == Kind::kName) return CallNamed(function.text, node, *arguments);
    if (function.kind != Kind::kMember) return Refuse("only functions and methods can be called");
    if (IsModule(*function.parts[0])) return CallNamed(function.text, node, *arguments);
    const auto of = Of(*function.parts[0]);
    return of ? CallMethod(*of, function.text, *arguments) : of;
  }

  base::Result<Value> CallNamed(const std::string& name, const Expression& node,
                                const std::vector<Value>& arguments) {
    if (name == "dict") return DictionaryOf(node, arguments);
    if (!node.words.empty()) return Refuse(name + "() takes no arguments by name");
    const auto* text = arguments.size() == 1 ? arguments[0].as<std::string>() : nullptr;
    if (name == "load_yaml" && text != nullptr && context_.load_yaml) {
      return context_.load_yaml(*text);
    }
    if (name == "arg" && text != nullptr && context_.argument) {
      return context_.argument(*text);
    }
    if (name == "message" || name == "warning" || name == "error") {
      if (context_.report) context_.report(Joined(arguments));
      return Value{std::string()};
    }
    if (name == "print_location") return Value{std::string()};
    if (name == "fatal") return Refuse(Joined(arguments));
    if (IsFunction(name)) return CallFunction(name, arguments);
    return Refuse("the call of " + name + "() is not supported");
  }

  static std::string Joined(const std::vector<Value>& values) {
    std::string text;
    for (const Value& value : values) text += (text.empty() ? "" : " ") + ToText(value);
    return text;
  }

  base::Result<Value> DictionaryOf(const Expression& node, const std::vector<Value>& arguments) {
    if (node.words.size() != arguments.size()) return Refuse("dict() takes arguments by name");
    Dictionary entries;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      entries.emplace_back(Value{node.words[i]}, arguments[i]);
    }
    return MakeDictionary(std::move(entries));
  }

  base::Result<Value> Unary(const Expression& node) {
    const auto operand = Of(*node.parts[0]);
    if (!operand) return operand;
    if (node.text == "not") return Value{!IsTrue(*operand)};
    if (node.text == "-") return Negative(*operand);
    if (!operand->is_number()) return Refuse("\"+\" takes a number");
    return operand;
  }

  base::Result<Value> Binary(const Expression& node) {
    const auto a = Of(*node.parts[0]);
    if (!a) return a;
    const auto b = Of(*node.parts[1]);
    return b ? Apply(node.text, *a, *b) : b;
  }

  base::Result<Value> Comparison(const Expression& node) {
    auto a = Of(*node.parts[0]);
    if (!a) return a;
    for (std::size_t i = 0; i < node.words.size(); ++i) {
      auto b = Of(*node.parts[i + 1]);
      if (!b) return b;
      const auto holds = Compare(node.words[i], *a, *b);
      if (!holds) return base::Fail(holds.error());
      if (!*holds) return Value{false};
      a = std::move(b);
    }
    return Value{true};
  }

  base::Result<Value> Logic(const Expression& node) {
    auto a = Of(*node.parts[0]);
    if (!a || IsTrue(*a) == (node.kind == Kind::kOr)) return a;
    return Of(*node.parts[1]);
  }

  const EvaluationContext& context_;
};

}  // namespace

base::Result<Value> Evaluate(const std::string& expression, const EvaluationContext& context) {
  const auto parsed = ParseExpression(expression);
  if (!parsed) return base::Fail(parsed.error());
  auto value = Evaluator(context).Of(**parsed);
  std::size_t room = kMaxValues;
  if (value && !Fits(*value, room)) {
    return base::Fail(base::ErrorCode::kBadModel, "a list or dictionary has more than " +
                                                      std::to_string(kMaxValues) + " values");
  }
  return value;
}

}  // namespace gsv::formats::xacro
