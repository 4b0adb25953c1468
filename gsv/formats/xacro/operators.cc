#include "gsv/formats/xacro/operators.h"

#include <algorithm>
#include <cmath>

namespace gsv::formats::xacro {
namespace {

constexpr std::size_t kLongestText = 1u << 20;
constexpr std::size_t kLongestList = 10'000;

tl::unexpected<base::Error> WrongOperand(const std::string& why) {
  return base::Fail(base::ErrorCode::kBadModel, why);
}

tl::unexpected<base::Error> WrongTypes(const std::string& sign, const Value& a, const Value& b) {
  return WrongOperand("\"" + sign + "\" does not take " + TypeName(a) + " and " + TypeName(b));
}

// Returns an integer. A bool counts as 0 or 1.
std::optional<std::int64_t> IntegerIn(const Value& value) {
  if (const auto* truth = value.as<bool>()) return *truth ? 1 : 0;
  if (const auto* number = value.as<std::int64_t>()) return *number;
  return std::nullopt;
}

double NumberIn(const Value& value) {
  const auto integer = IntegerIn(value);
  return integer ? static_cast<double>(*integer) : *value.as<double>();
}

base::Result<Value> Power(std::int64_t base, std::int64_t exponent) {
  std::int64_t power = 1;
  // A power with |base| >= 2 exceeds 64 bits after 63 iterations.
  if (base == 0 || base == 1) return Value{exponent == 0 ? std::int64_t{1} : base};
  if (base == -1) return Value{std::int64_t{exponent % 2 == 0 ? 1 : -1}};
  for (std::int64_t i = 0; i < exponent; ++i) {
    if (__builtin_mul_overflow(power, base, &power)) {
      return WrongOperand("an integer is beyond 64 bits");
    }
  }
  return Value{power};
}

base::Result<Value> ApplyToIntegers(const std::string& sign, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  bool overflows = false;
  if (sign == "+") overflows = __builtin_add_overflow(a, b, &result);
  if (sign == "-") overflows = __builtin_sub_overflow(a, b, &result);
  if (sign == "*") overflows = __builtin_mul_overflow(a, b, &result);
  if (sign == "**") return Power(a, b);
  if (sign == "//" || sign == "%") {
    if (b == 0) return WrongOperand("division by zero");
    if (b == -1) {
      overflows = __builtin_sub_overflow(std::int64_t{0}, a, &result);
      if (sign == "%") return Value{std::int64_t{0}};
    } else {
      // The quotient is rounded down, as in Python.
      const bool is_uneven = a % b != 0 && (a < 0) != (b < 0);
      result = sign == "//" ? a / b - (is_uneven ? 1 : 0) : a % b + (is_uneven ? b : 0);
    }
  }
  if (overflows) return WrongOperand("an integer is beyond 64 bits");
  return Value{result};
}

base::Result<Value> ApplyToFloats(const std::string& sign, double a, double b) {
  if (sign == "+") return Value{a + b};
  if (sign == "-") return Value{a - b};
  if (sign == "*") return Value{a * b};
  if (sign == "**") {
    const double power = std::pow(a, b);
    if (a == 0 && b < 0) return WrongOperand("zero cannot be raised to a negative power");
    if (std::isnan(power) && !std::isnan(a) && !std::isnan(b)) {
      return WrongOperand("a negative number cannot be raised to a fraction");
    }
    return Value{power};
  }
  if (b == 0) return WrongOperand("division by zero");
  if (sign == "/") return Value{a / b};
  double rest = std::fmod(a, b);
  if (rest != 0 && (rest < 0) != (b < 0)) rest += b;
  return Value{sign == "%" ? rest : std::floor((a - rest) / b + 0.5)};
}

base::Result<Value> Repeated(const Value& sequence, std::int64_t times) {
  const auto count = static_cast<std::size_t>(std::clamp<std::int64_t>(times, 0, kLongestText + 1));
  if (const auto* text = sequence.as<std::string>()) {
    if (text->size() * count > kLongestText) return WrongOperand("a text is too long");
    std::string repeated;
    for (std::size_t i = 0; i < count; ++i) repeated += *text;
    return Value{repeated};
  }
  if (sequence.items()->size() * count > kLongestList) return WrongOperand("a list is too long");
  List repeated;
  for (std::size_t i = 0; i < count; ++i) {
    repeated.insert(repeated.end(), sequence.items()->begin(), sequence.items()->end());
  }
  return sequence.as<Tuple>() != nullptr ? MakeTuple(repeated) : MakeList(repeated);
}

bool IsSequence(const Value& value) {
  return value.as<std::string>() != nullptr || value.items() != nullptr;
}

base::Result<Value> Joined(const Value& a, const Value& b) {
  if (const auto* text = a.as<std::string>()) {
    if (text->size() + b.as<std::string>()->size() > kLongestText) {
      return WrongOperand("a text is too long");
    }
    return Value{*text + *b.as<std::string>()};
  }
  List joined = *a.items();
  joined.insert(joined.end(), b.items()->begin(), b.items()->end());
  if (joined.size() > kLongestList) return WrongOperand("a list is too long");
  return a.as<Tuple>() != nullptr ? MakeTuple(joined) : MakeList(joined);
}

base::Result<bool> Contains(const Value& a, const Value& b) {
  if (const auto* text = b.as<std::string>()) {
    const auto* part = a.as<std::string>();
    if (part == nullptr) return WrongTypes("in", a, b);
    return text->find(*part) != std::string::npos;
  }
  if (const List* items = b.items()) {
    return std::any_of(items->begin(), items->end(),
                       [&](const Value& item) { return AreEqual(a, item); });
  }
  if (const Dictionary* entries = b.dictionary()) {
    return std::any_of(entries->begin(), entries->end(),
                       [&](const auto& entry) { return AreEqual(a, entry.first); });
  }
  return WrongTypes("in", a, b);
}

template <typename T>
bool Ordered(const std::string& word, const T& a, const T& b) {
  if (word == "<") return a < b;
  if (word == "<=") return a <= b;
  return word == ">" ? a > b : a >= b;
}

std::size_t LengthOf(const Value& value) {
  if (const auto* text = value.as<std::string>()) return text->size();
  return value.items()->size();
}

}  // namespace

base::Result<Value> Apply(const std::string& sign, const Value& a, const Value& b) {
  const auto i = IntegerIn(a), j = IntegerIn(b);
  if (i && j && sign != "/" && !(sign == "**" && *j < 0)) return ApplyToIntegers(sign, *i, *j);
  if (a.is_number() && b.is_number()) return ApplyToFloats(sign, NumberIn(a), NumberIn(b));
  if (sign == "*" && IsSequence(a) && j) return Repeated(a, *j);
  if (sign == "*" && IsSequence(b) && i) return Repeated(b, *i);
  if (sign == "+" && IsSequence(a) && a.content.index() == b.content.index()) return Joined(a, b);
  return WrongTypes(sign, a, b);
}

base::Result<Value> Negative(const Value& value) {
  if (const auto integer = IntegerIn(value)) return ApplyToIntegers("-", 0, *integer);
  if (value.is_number()) return Value{-NumberIn(value)};
  return WrongOperand(std::string("\"-\" does not take ") + TypeName(value));
}

base::Result<bool> Compare(const std::string& word, const Value& a, const Value& b) {
  if (word == "==") return AreEqual(a, b);
  if (word == "!=") return !AreEqual(a, b);
  if (word == "in") return Contains(a, b);
  if (word == "not in") {
    const auto contains = Contains(a, b);
    return contains ? base::Result<bool>(!*contains) : contains;
  }
  if (a.is_number() && b.is_number()) return Ordered(word, NumberIn(a), NumberIn(b));
  if (a.as<std::string>() != nullptr && b.as<std::string>() != nullptr) {
    return Ordered(word, *a.as<std::string>(), *b.as<std::string>());
  }
  return WrongTypes(word, a, b);
}

base::Result<Value> Index(const Value& of, const Value& index) {
  if (const Dictionary* entries = of.dictionary()) {
    for (const auto& [key, value] : *entries) {
      if (AreEqual(key, index)) return value;
    }
    return WrongOperand("there is no key " + ToText(index));
  }
  const auto number = IntegerIn(index);
  if (!number || !IsSequence(of)) return WrongTypes("[]", of, index);
  const auto length = static_cast<std::int64_t>(LengthOf(of));
  const std::int64_t at = *number < 0 ? *number + length : *number;
  if (at < 0 || at >= length) {
    return WrongOperand("the index " + std::to_string(*number) + " is out of range");
  }
  if (const auto* text = of.as<std::string>()) {
    return Value{text->substr(static_cast<std::size_t>(at), 1)};
  }
  return (*of.items())[static_cast<std::size_t>(at)];
}

base::Result<Value> Slice(const Value& of, const Value& from, const Value& to) {
  if (!IsSequence(of)) return WrongTypes("[:]", of, from);
  const auto length = static_cast<std::int64_t>(LengthOf(of));
  const auto end_of = [&](const Value& value, std::int64_t otherwise) {
    const auto number = IntegerIn(value);
    if (!number) return otherwise;
    return std::clamp<std::int64_t>(*number < 0 ? *number + length : *number, 0, length);
  };
  const std::int64_t first = end_of(from, 0);
  const std::int64_t last = std::max(first, end_of(to, length));
  if (const auto* text = of.as<std::string>()) {
    return Value{
        text->substr(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first))};
  }
  return MakeList(List(of.items()->begin() + first, of.items()->begin() + last));
}

base::Result<Value> Member(const Value& of, const std::string& name) {
  if (const auto* names = of.as<const Names*>()) {
    if (auto value = (*names)->Member(name)) return *std::move(value);
    return WrongOperand("the namespace has no property \"" + name + "\"");
  }
  if (of.dictionary() != nullptr) return Index(of, Value{name});
  return WrongOperand(std::string("a ") + TypeName(of) + " has no \"" + name + "\"");
}

}  // namespace gsv::formats::xacro
