#include "gsv/formats/xacro/operators.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace gsv::formats::xacro {
namespace {

constexpr std::size_t kMaxTextLength = 1u << 20;
constexpr std::size_t kMaxListLength = 10'000;

base::Failure<base::Error> WrongOperand(const std::string& why) {
  return base::Fail(base::ErrorCode::kBadModel, why);
}

base::Failure<base::Error> WrongTypes(const std::string& sign, const Value& a, const Value& b) {
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
  // Handles the bases 0, 1 and -1 without the loop below, because `exponent` may be huge. For other
  // bases the loop is short: after at most 64 iterations the power exceeds 64 bits.
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
  const auto count =
      static_cast<std::size_t>(std::clamp<std::int64_t>(times, 0, kMaxTextLength + 1));
  if (const auto* text = sequence.as<std::string>()) {
    if (text->size() * count > kMaxTextLength) return WrongOperand("a string is longer than 1 MiB");
    std::string repeated;
    for (std::size_t i = 0; i < count; ++i) repeated += *text;
    return Value{repeated};
  }
  if (sequence.items()->size() * count > kMaxListLength)
    return WrongOperand("a list has more than 10000 values");
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
    if (text->size() + b.as<std::string>()->size() > kMaxTextLength) {
      return WrongOperand("a string is longer than 1 MiB");
    }
    return Value{*text + *b.as<std::string>()};
  }
  List joined = *a.items();
  joined.insert(joined.end(), b.items()->begin(), b.items()->end());
  if (joined.size() > kMaxListLength) return WrongOperand("a list has more than 10000 values");
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

constexpr int kMaxFieldWidth = 100;

// The values for a format string ("%d"), from left to right: the items of a tuple, or a single
// other value.
class FormatValues {
 public:
  explicit FormatValues(const Value& value) : value_(value) {}

  const Value* Next() {
    const List* items = value_.as<Tuple>() != nullptr ? value_.items() : nullptr;
    if (items == nullptr) return next_++ == 0 ? &value_ : nullptr;
    return next_ < items->size() ? &(*items)[next_++] : nullptr;
  }
  bool is_used_up() const {
    return next_ == (value_.as<Tuple>() != nullptr ? value_.items()->size() : 1);
  }

 private:
  const Value& value_;
  std::size_t next_ = 0;
};

// A field of a format string, such as "%-8.3f".
struct Field {
  bool is_left = false, has_zeros = false, has_plus = false, has_blank = false;
  int width = 0, precision = 6;
  char kind = '\0';
};

// Reads the field at `i` of `format`, and moves `i` to its last character. If there is no valid
// field, the result has no kind.
Field FieldAt(const std::string& format, std::size_t& i) {
  Field field;
  const auto number = [&] {
    int value = 0;
    while (i + 1 < format.size() && std::isdigit(static_cast<unsigned char>(format[i + 1])) != 0) {
      value = std::min(value * 10 + (format[++i] - '0'), kMaxFieldWidth + 1);
    }
    return value;
  };
  for (; i + 1 < format.size() && std::strchr("-0+ ", format[i + 1]) != nullptr; ++i) {
    const char flag = format[i + 1];
    field.is_left = field.is_left || flag == '-';
    field.has_zeros = field.has_zeros || flag == '0';
    field.has_plus = field.has_plus || flag == '+';
    field.has_blank = field.has_blank || flag == ' ';
  }
  field.width = number();
  if (i + 1 < format.size() && format[i + 1] == '.') {
    ++i;
    field.precision = number();
  }
  if (i + 1 < format.size()) field.kind = format[++i];
  if (field.width > kMaxFieldWidth || field.precision > kMaxFieldWidth) field.kind = '\0';
  return field;
}

// Returns the digits of |value|; empty if the field is not for numbers.
std::string Digits(const Field& field, double value) {
  char text[512] = "";
  switch (field.kind) {
    case 'd':
    case 'i':
      std::snprintf(text, sizeof text, "%.0f", std::trunc(value));
      break;
    case 'f':
      std::snprintf(text, sizeof text, "%.*f", field.precision, value);
      break;
    case 'e':
      std::snprintf(text, sizeof text, "%.*e", field.precision, value);
      break;
    case 'g':
      std::snprintf(text, sizeof text, "%.*g", field.precision, value);
      break;
    default:
      break;
  }
  return text;
}

base::Status AppendFormatted(const Field& field, const Value& value, std::string& text) {
  std::string sign, content;
  if (field.kind == 's') {
    content = ToText(value);
  } else if (!value.is_number()) {
    return WrongOperand(std::string("\"%\" does not take ") + TypeName(value) + " for a number");
  } else {
    const double number = NumberIn(value);
    content = Digits(field, std::abs(number));
    sign = std::signbit(number) ? "-" : field.has_plus ? "+" : field.has_blank ? " " : "";
  }
  if (content.empty() && field.kind != 's') {
    return WrongOperand("a field of the format is not supported");
  }
  const auto used = static_cast<int>(sign.size() + content.size());
  const std::string padding(static_cast<std::size_t>(std::max(0, field.width - used)),
                            field.has_zeros && !field.is_left && field.kind != 's' ? '0' : ' ');
  if (field.is_left) {
    text += sign + content + padding;
  } else {
    text += padding.starts_with('0') ? sign + padding + content : padding + sign + content;
  }
  return {};
}

// Formats values like Python's operator %, as in '%.2f' % 1.5.
base::Result<Value> Formatted(const std::string& format, const Value& value) {
  std::string text;
  FormatValues values(value);
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') {
      text += format[i];
    } else if (format.compare(i, 2, "%%") == 0) {
      text += format[i++];
    } else {
      const Field field = FieldAt(format, i);
      const Value* next = values.Next();
      if (next == nullptr) return WrongOperand("the format string has more fields than values");
      if (auto status = AppendFormatted(field, *next, text); !status) {
        return base::Fail(status.error());
      }
    }
    if (text.size() > kMaxTextLength) return WrongOperand("a string is longer than 1 MiB");
  }
  if (!values.is_used_up()) return WrongOperand("the format string has fewer fields than values");
  return Value{text};
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
  if (sign == "%" && a.as<std::string>() != nullptr) return Formatted(*a.as<std::string>(), b);
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
