#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gsv/base/named.h"
#include "gsv/formats/xacro/operators.h"
#include "gsv/formats/xacro/sequences.h"

namespace gsv::formats::xacro {
namespace {

constexpr std::size_t kMaxResultLength = 1u << 20;

using Arguments = std::vector<Value>;
using Function = base::Result<Value> (*)(const Arguments&);

base::Failure<base::Error> InvalidCall(const std::string& why) {
  return base::Fail(base::ErrorCode::kBadModel, why);
}

double Real(const Value& value) {
  if (const auto* truth = value.as<bool>()) return *truth ? 1 : 0;
  if (const auto* number = value.as<std::int64_t>()) return static_cast<double>(*number);
  return *value.as<double>();
}

base::Result<Value> Whole(double value) {
  if (!(std::abs(value) < 9e18)) return InvalidCall("the number is beyond 64 bits");
  return Value{static_cast<std::int64_t>(value)};
}

// A function of one real number.
using RealFunction = double (*)(double);
constexpr base::Named<RealFunction> kRealFunctions[] = {
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"log10", [](double x) { return std::log10(x); }},
    {"log2", [](double x) { return std::log2(x); }},
    {"fabs", [](double x) { return std::abs(x); }},
    // Uses the same operations as CPython, so that the results are bit-identical.
    {"radians", [](double x) { return x * (std::numbers::pi / 180); }},
    {"degrees", [](double x) { return x * (180 / std::numbers::pi); }},
};

using Surface2 = double (*)(double, double);
constexpr base::Named<Surface2> kSurfaces[] = {
    {"atan2", [](double y, double x) { return std::atan2(y, x); }},
    {"pow", [](double x, double y) { return std::pow(x, y); }},
    {"fmod", [](double x, double y) { return std::fmod(x, y); }},
    {"hypot", [](double x, double y) { return std::hypot(x, y); }},
    {"copysign", [](double x, double y) { return std::copysign(x, y); }},
};

base::Result<Value> Absolute(const Arguments& a) {
  if (a.size() != 1 || !a[0].is_number()) return InvalidCall("abs() takes one number");
  const auto is_negative = Compare("<", a[0], Value{std::int64_t{0}});
  if (*is_negative) return Negative(a[0]);
  return a[0].as<bool>() != nullptr ? Value{static_cast<std::int64_t>(*a[0].as<bool>())} : a[0];
}

base::Result<Value> Extreme(const Arguments& given, const char* word) {
  const bool is_one = given.size() == 1 && given[0].items() != nullptr;
  const List& items = is_one ? *given[0].items() : given;
  if (items.empty()) return InvalidCall("min() and max() need at least one value");
  const Value* best = &items[0];
  for (const Value& item : items) {
    const auto is_better = Compare(word, item, *best);
    if (!is_better) return base::Fail(is_better.error());
    if (*is_better) best = &item;
  }
  return *best;
}

// Rounds to a multiple of a power of ten, which is at most 1e22, so that it is exact. A value halfway
// between two multiples becomes the multiple with the even quotient.
double RoundedToMultiple(double value, double power) {
  const double rest = std::fmod(value, power), multiple = value - rest;
  const double twice = 2 * std::abs(rest);
  const bool is_odd = std::fmod(multiple / power, 2) != 0;
  const bool is_away = twice > power || (twice == power && is_odd);
  return is_away ? multiple + std::copysign(power, value) : multiple;
}

// Implements round(). Halves are rounded to the nearest even integer.
base::Result<Value> Round(const Arguments& a) {
  if (a.empty() || a.size() > 2 || !a[0].is_number()) return InvalidCall("round() takes a number");
  if (a.size() == 1) return Whole(std::nearbyint(Real(a[0])));
  const auto* digits = a[1].as<std::int64_t>();
  if (digits == nullptr || *digits < -22 || *digits > 300) {
    return InvalidCall("the second argument of round() must be a whole number from -22 to 300");
  }
  if (*digits < 0) {
    const double power = std::pow(10.0, static_cast<double>(-*digits));
    const double rounded = RoundedToMultiple(Real(a[0]), power);
    return a[0].as<double>() != nullptr ? base::Result<Value>(Value{rounded}) : Whole(rounded);
  }
  // Uses the decimal text, as Python does, so that 2.675 becomes 2.67.
  if (a[0].as<double>() != nullptr && std::abs(Real(a[0])) < 1e17) {
    char text[400];
    std::snprintf(text, sizeof text, "%.*f", static_cast<int>(*digits), Real(a[0]));
    return Value{*ParseFloat(text)};
  }
  return a[0];
}

base::Result<Value> Sum(const Arguments& a) {
  if (a.size() != 1 || a[0].items() == nullptr) return InvalidCall("sum() takes a list");
  base::Result<Value> sum = Value{std::int64_t{0}};
  for (const Value& item : *a[0].items()) {
    if (sum) sum = Apply("+", Value(*sum), item);
  }
  return sum;
}

base::Result<Value> Length(const Arguments& a) {
  if (a.size() == 1) {
    if (const auto* text = a[0].as<std::string>()) {
      return Value{static_cast<std::int64_t>(text->size())};
    }
    if (a[0].items() != nullptr) return Value{static_cast<std::int64_t>(a[0].items()->size())};
    if (a[0].dictionary() != nullptr) {
      return Value{static_cast<std::int64_t>(a[0].dictionary()->size())};
    }
  }
  return InvalidCall("len() takes a string, list or dictionary");
}

base::Result<Value> ToInteger(const Arguments& a) {
  if (a.size() != 1) return InvalidCall("int() takes one value");
  if (a[0].is_number()) {
    if (const auto* number = a[0].as<std::int64_t>()) return Value{*number};
    return Whole(std::trunc(Real(a[0])));
  }
  const auto* text = a[0].as<std::string>();
  const auto number = text == nullptr ? std::nullopt : ParseInteger(*text);
  if (!number) return InvalidCall("int() does not take " + ToText(a[0]));
  return Value{*number};
}

base::Result<Value> ToFloat(const Arguments& a) {
  if (a.size() != 1) return InvalidCall("float() takes one value");
  if (a[0].is_number()) return Value{Real(a[0])};
  const auto* text = a[0].as<std::string>();
  const auto number = text == nullptr ? std::nullopt : ParseFloat(*text);
  if (!number) return InvalidCall("float() does not take " + ToText(a[0]));
  return Value{*number};
}

base::Result<Value> Rounded(const Arguments& a, double (*round)(double)) {
  if (a.size() != 1 || !a[0].is_number()) return InvalidCall("the function takes one number");
  return Whole(round(Real(a[0])));
}

base::Result<Value> Logarithm(const Arguments& a) {
  if (a.empty() || a.size() > 2 || !a[0].is_number() || !a.back().is_number() ||
      !(Real(a[0]) > 0) || !(Real(a.back()) > 0)) {
    return InvalidCall("log() takes numbers above zero");
  }
  const double logarithm = std::log(Real(a[0]));
  return Value{a.size() == 1 ? logarithm : logarithm / std::log(Real(a[1]))};
}

base::Result<Value> Items(const Arguments& a, Value (*make)(List)) {
  if (a.empty()) return make({});
  if (a.size() == 1 && a[0].items() != nullptr) return make(*a[0].items());
  if (a.size() == 1 && a[0].dictionary() != nullptr) {
    List keys;
    for (const auto& [key, value] : *a[0].dictionary()) keys.push_back(key);
    return make(std::move(keys));
  }
  return InvalidCall("list() and tuple() take a list");
}

constexpr base::Named<Function> kFunctions[] = {
    {"abs", &Absolute},
    {"min", [](const Arguments& a) { return Extreme(a, "<"); }},
    {"max", [](const Arguments& a) { return Extreme(a, ">"); }},
    {"round", &Round},
    {"sum", &Sum},
    {"len", &Length},
    {"int", &ToInteger},
    {"float", &ToFloat},
    {"log", &Logarithm},
    {"floor", [](const Arguments& a) { return Rounded(a, &std::floor); }},
    {"ceil", [](const Arguments& a) { return Rounded(a, &std::ceil); }},
    {"trunc", [](const Arguments& a) { return Rounded(a, &std::trunc); }},
    {"list", [](const Arguments& a) { return Items(a, &MakeList); }},
    {"tuple", [](const Arguments& a) { return Items(a, &MakeTuple); }},
    {"str",
     [](const Arguments& a) -> base::Result<Value> {
       return Value{a.empty() ? std::string() : ToText(a[0])};
     }},
    {"bool",
     [](const Arguments& a) -> base::Result<Value> { return Value{!a.empty() && IsTrue(a[0])}; }},
};

bool AreNumbers(const Arguments& a) {
  return std::all_of(a.begin(), a.end(), [](const Value& value) { return value.is_number(); });
}

// Returns a real result of real arguments, or an error where Python raises an exception.
base::Result<Value> RealResult(const std::string& name, double result, const Arguments& a) {
  const bool are_finite =
      std::all_of(a.begin(), a.end(), [](const Value& v) { return std::isfinite(Real(v)); });
  if (are_finite && !std::isfinite(result)) {
    return InvalidCall(name + "() is not defined for " + ToText(a[0]));
  }
  return Value{result};
}

std::string WithoutBlanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

List Split(const std::string& text, const std::string& separator) {
  List parts;
  if (separator.empty()) {
    std::size_t at = 0;
    while ((at = text.find_first_not_of(" \t\r\n", at)) != std::string::npos) {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
      parts.push_back({text.substr(at, end - at)});
      at = end;
    }
    return parts;
  }
  std::size_t from = 0;
  for (;;) {
    const std::size_t at = text.find(separator, from);
    parts.push_back({text.substr(from, at - from)});
    if (at == std::string::npos) return parts;
    from = at + separator.size();
  }
}

base::Result<Value> Replaced(const std::string& text, const std::string& what,
                             const std::string& by) {
  if (what.empty()) return InvalidCall("replace() needs a string to replace");
  std::string replaced;
  std::size_t from = 0;
  for (;;) {
    const std::size_t at = text.find(what, from);
    replaced += text.substr(from, at - from);
    if (at == std::string::npos) return Value{replaced};
    replaced += by;
    from = at + what.size();
    if (replaced.size() > kMaxResultLength) return InvalidCall("a string is longer than 1 MiB");
  }
}

base::Result<Value> Join(const std::string& text, const List& parts) {
  std::string joined;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto* part = parts[i].as<std::string>();
    if (part == nullptr) return InvalidCall("join() takes a list of strings");
    joined += (i == 0 ? "" : text) + *part;
    if (joined.size() > kMaxResultLength) return InvalidCall("a string is longer than 1 MiB");
  }
  return Value{joined};
}

base::Result<Value> TextMethod(const std::string& text, const std::string& name,
                               const Arguments& a) {
  const bool are_texts = std::all_of(
      a.begin(), a.end(), [](const Value& value) { return value.as<std::string>() != nullptr; });
  if (name == "join" && a.size() == 1 && a[0].items() != nullptr) return Join(text, *a[0].items());
  if (name == "format") return Formatted(text, a);
  if (name == "zfill" && a.size() == 1 && a[0].as<std::int64_t>() != nullptr) {
    const auto width =
        static_cast<std::size_t>(std::clamp<std::int64_t>(*a[0].as<std::int64_t>(), 0, 1000));
    const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
    std::string filled = text;
    if (filled.size() < width) filled.insert(sign, width - filled.size(), '0');
    return Value{filled};
  }
  if (!are_texts) return InvalidCall(name + "() takes strings");
  if (name == "isdigit" && a.empty()) {
    return Value{!text.empty() && text.find_first_not_of("0123456789") == std::string::npos};
  }
  if (name == "capitalize" && a.empty()) {
    std::string changed = text;
    for (std::size_t i = 0; i < changed.size(); ++i) {
      const auto c = static_cast<unsigned char>(changed[i]);
      changed[i] = static_cast<char>(i == 0 ? std::toupper(c) : std::tolower(c));
    }
    return Value{changed};
  }
  if (name == "find" && a.size() == 1) {
    const std::size_t at = text.find(*a[0].as<std::string>());
    return Value{at == std::string::npos ? std::int64_t{-1} : static_cast<std::int64_t>(at)};
  }
  if ((name == "lower" || name == "upper") && a.empty()) {
    std::string changed = text;
    std::transform(changed.begin(), changed.end(), changed.begin(), [&](unsigned char c) {
      return static_cast<char>(name == "lower" ? std::tolower(c) : std::toupper(c));
    });
    return Value{changed};
  }
  if (name == "strip" && a.empty()) return Value{WithoutBlanks(text)};
  if (name == "split" && a.size() <= 1) {
    if (a.size() == 1 && a[0].as<std::string>()->empty())
      return InvalidCall("the separator of split() must not be empty");
    return MakeList(Split(text, a.empty() ? "" : *a[0].as<std::string>()));
  }
  if (name == "startswith" && a.size() == 1)
    return Value{text.starts_with(*a[0].as<std::string>())};
  if (name == "endswith" && a.size() == 1) return Value{text.ends_with(*a[0].as<std::string>())};
  if (name == "replace" && a.size() == 2) {
    return Replaced(text, *a[0].as<std::string>(), *a[1].as<std::string>());
  }
  return InvalidCall("the string method " + name + "() is not supported");
}

base::Result<Value> DictionaryMethod(const Dictionary& entries, const std::string& name,
                                     const Arguments& a) {
  if (name == "get" && (a.size() == 1 || a.size() == 2)) {
    for (const auto& [key, value] : entries) {
      if (AreEqual(key, a[0])) return value;
    }
    return a.size() == 2 ? a[1] : Value{};
  }
  if (!a.empty() || (name != "keys" && name != "values" && name != "items")) {
    return InvalidCall("the dictionary method " + name + "() is not supported");
  }
  List items;
  for (const auto& [key, value] : entries) {
    if (name == "items") items.push_back(MakeTuple({key, value}));
    if (name == "keys") items.push_back(key);
    if (name == "values") items.push_back(value);
  }
  return MakeList(std::move(items));
}

}  // namespace

std::optional<Value> Constant(const std::string& name) {
  if (name == "pi") return Value{std::numbers::pi};
  if (name == "tau") return Value{2 * std::numbers::pi};
  if (name == "e") return Value{std::numbers::e};
  if (name == "inf") return Value{std::numeric_limits<double>::infinity()};
  if (name == "nan") return Value{std::numeric_limits<double>::quiet_NaN()};
  return std::nullopt;
}

bool IsFunction(const std::string& name) {
  return base::FindNamed(kFunctions, name) != nullptr || IsSequenceFunction(name) ||
         base::FindNamed(kRealFunctions, name) != nullptr ||
         base::FindNamed(kSurfaces, name) != nullptr;
}

base::Result<Value> CallFunction(const std::string& name, const Arguments& arguments) {
  if (const Function* function = base::FindNamed(kFunctions, name)) return (*function)(arguments);
  if (IsSequenceFunction(name)) return CallSequenceFunction(name, arguments);
  if (const RealFunction* function = base::FindNamed(kRealFunctions, name)) {
    if (arguments.size() != 1 || !AreNumbers(arguments))
      return InvalidCall(name + "() takes a number");
    return RealResult(name, (*function)(Real(arguments[0])), arguments);
  }
  if (const Surface2* function = base::FindNamed(kSurfaces, name)) {
    if (arguments.size() != 2 || !AreNumbers(arguments)) {
      return InvalidCall(name + "() takes two numbers");
    }
    return RealResult(name, (*function)(Real(arguments[0]), Real(arguments[1])), arguments);
  }
  return InvalidCall("there is no function " + name + "()");
}

base::Result<Value> CallMethod(const Value& of, const std::string& name,
                               const Arguments& arguments) {
  if (const auto* text = of.as<std::string>()) return TextMethod(*text, name, arguments);
  if (of.dictionary() != nullptr) return DictionaryMethod(*of.dictionary(), name, arguments);
  return InvalidCall("a value of type " + std::string(TypeName(of)) + " has no supported method " +
                     name + "()");
}

}  // namespace gsv::formats::xacro
