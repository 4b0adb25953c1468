#include "gsv/broker/testing/naive_evaluator.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <variant>

namespace gsv::broker {
namespace {

// Letters are those of ISO Latin-1. The characters × and ÷ are in the same range, but are no
// letters.
bool IsInName(char character) {
  const auto code = static_cast<unsigned char>(character);
  if (code >= 0xC0) return code != 0xD7 && code != 0xF7;
  return code < 0x80 && (std::isalnum(code) != 0 || code == '_');
}

// Thrown if there is no value. It ends the whole evaluation.
struct NoValue {};

// Holds every sum and product of two 64-bit integers.
__extension__ typedef __int128 Integer;

// A number. If `integer` is true, its value is `whole`, else `real`.
struct Number {
  bool integer;
  Integer whole;
  double real;
  long double Wide() const { return integer ? static_cast<long double>(whole) : real; }
};

using Result = std::variant<bool, Number, std::string>;

Number Whole(Integer value) {
  constexpr Integer kMaxInteger = INT64_MAX;
  constexpr Integer kMinInteger = INT64_MIN;
  if (value > kMaxInteger || value < kMinInteger) return {false, 0, static_cast<double>(value)};
  return {true, value, 0};
}

class Reader {
 public:
  Reader(const std::string& text, const PropertyList& offer) : text_(text), offer_(offer) {}

  bool Constraint() {
    Skip();
    if (at_ == text_.size()) return true;
    const bool result = Truth(Or(true));
    if (at_ != text_.size()) throw std::logic_error("not a constraint: " + text_);
    return result;
  }

 private:
  // If `live` is false, the text is parsed but not evaluated.
  Result Or(bool live) {
    Result left = And(live);
    while (Word("or")) {
      const bool decided = live && Truth(left);
      const Result right = And(live && !decided);
      if (live && !decided) left = Truth(right);
    }
    return left;
  }

  Result And(bool live) {
    Result left = Compare(live);
    while (Word("and")) {
      const bool decided = live && !Truth(left);
      const Result right = Compare(live && !decided);
      if (live && !decided) left = Truth(right);
    }
    return left;
  }

  Result Compare(bool live) {
    const Result left = In(live);
    for (const char* sign : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (!Sign(sign)) continue;
      const Result right = In(live);
      if (!live) return false;
      const int order = Order(left, right);
      const std::string name = sign;
      if (name == "==") return order == 0;
      if (name == "!=") return order != 0;
      if (name == "<=") return order <= 0;
      if (name == ">=") return order >= 0;
      return name == "<" ? order < 0 : order > 0;
    }
    return left;
  }

  Result In(bool live) {
    const Result left = Twiddle(live);
    if (!Word("in")) return left;
    const std::string name = Name();
    if (!live) return false;
    const Value* value = offer_.Find(name);
    if (value == nullptr || !value->is_sequence()) throw NoValue{};
    for (const ScalarValue& element : *value->AsSequence()) {
      if (Order(left, FromScalar(element)) == 0) return true;
    }
    return false;
  }

  Result Twiddle(bool live) {
    const Result left = Sum(live);
    if (!Sign("~")) return left;
    const Result right = Sum(live);
    if (!live) return false;
    return Text(right).find(Text(left)) != std::string::npos;
  }

  Result Sum(bool live) {
    Result left = Product(live);
    for (;;) {
      if (Sign("+")) {
        left = Calculate('+', left, Product(live), live);
      } else if (Sign("-")) {
        left = Calculate('-', left, Product(live), live);
      } else {
        return left;
      }
    }
  }

  Result Product(bool live) {
    Result left = Not(live);
    for (;;) {
      if (Sign("*")) {
        left = Calculate('*', left, Not(live), live);
      } else if (Sign("/")) {
        left = Calculate('/', left, Not(live), live);
      } else {
        return left;
      }
    }
  }

  Result Not(bool live) {
    if (!Word("not")) return Factor(live);
    const Result operand = Factor(live);
    return live ? Result(!Truth(operand)) : Result(false);
  }

  Result Factor(bool live) {
    if (Sign("(")) {
      const Result inner = Or(live);
      if (!Sign(")")) throw std::logic_error("no ) in " + text_);
      return inner;
    }
    if (Word("exist")) return offer_.Find(Name()) != nullptr;
    if (Word("TRUE")) return true;
    if (Word("FALSE")) return false;
    if (at_ < text_.size() && text_[at_] == '\'') return Quoted();
    if (Sign("-")) {
      Number number = ReadNumber();
      number.whole = -number.whole;
      number.real = -number.real;
      return number;
    }
    if (at_ < text_.size() &&
        (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.'))
      return ReadNumber();
    const std::string name = Name();
    if (!live) return false;
    const Value* value = offer_.Find(name);
    if (value == nullptr) throw NoValue{};
    return FromValue(*value);
  }

  static Result Calculate(char sign, const Result& left, const Result& right, bool live) {
    if (!live) return false;
    const Number a = Numeric(left);
    const Number b = Numeric(right);
    if (sign == '/' && b.Wide() == 0) throw NoValue{};
    if (a.integer && b.integer) {
      switch (sign) {
        case '+':
          return Reals(Whole(a.whole + b.whole), a, b, '+');
        case '-':
          return Reals(Whole(a.whole - b.whole), a, b, '-');
        case '*':
          return Reals(Whole(a.whole * b.whole), a, b, '*');
        default:
          return Reals(Whole(a.whole / b.whole), a, b, '/');
      }
    }
    return Number{false, 0, Real(sign, a, b)};
  }

  // Returns `exact` if it is an integer. Otherwise returns the result of a calculation with
  // doubles.
  static Result Reals(const Number& exact, const Number& a, const Number& b, char sign) {
    if (exact.integer) return exact;
    return Number{false, 0, Real(sign, a, b)};
  }

  static double Real(char sign, const Number& a, const Number& b) {
    const double x = static_cast<double>(a.Wide());
    const double y = static_cast<double>(b.Wide());
    return sign == '+' ? x + y : sign == '-' ? x - y : sign == '*' ? x * y : x / y;
  }

  static int Order(const Result& left, const Result& right) {
    if (left.index() != right.index()) throw NoValue{};
    if (std::holds_alternative<bool>(left)) {
      return static_cast<int>(std::get<bool>(left)) - static_cast<int>(std::get<bool>(right));
    }
    if (std::holds_alternative<std::string>(left)) {
      return std::get<std::string>(left).compare(std::get<std::string>(right));
    }
    const long double a = Numeric(left).Wide();
    const long double b = Numeric(right).Wide();
    return a < b ? -1 : a > b ? 1 : 0;
  }

  static Result FromScalar(const ScalarValue& value) {
    if (const auto* truth = std::get_if<bool>(&value)) return *truth;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return Whole(*integer);
    if (const auto* real = std::get_if<double>(&value)) return Number{false, 0, *real};
    return std::get<std::string>(value);
  }

  static Result FromValue(const Value& value) {
    if (const auto truth = value.AsBoolean()) return *truth;
    if (const auto integer = value.AsInteger()) return Whole(*integer);
    if (const auto real = value.AsReal()) return Number{false, 0, *real};
    if (const auto text = value.AsText()) return std::string(*text);
    throw NoValue{};
  }

  static bool Truth(const Result& result) {
    if (!std::holds_alternative<bool>(result)) throw NoValue{};
    return std::get<bool>(result);
  }

  static Number Numeric(const Result& result) {
    if (!std::holds_alternative<Number>(result)) throw NoValue{};
    return std::get<Number>(result);
  }

  static std::string Text(const Result& result) {
    if (!std::holds_alternative<std::string>(result)) throw NoValue{};
    return std::get<std::string>(result);
  }

  void Skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  bool Sign(const std::string& sign) {
    if (text_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    Skip();
    return true;
  }

  bool Word(const std::string& word) {
    std::size_t end = at_;
    while (end < text_.size() && IsInName(text_[end])) ++end;
    if (text_.substr(at_, end - at_) != word) return false;
    at_ = end;
    Skip();
    return true;
  }

  std::string Name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && IsInName(text_[at_])) ++at_;
    std::string name = text_.substr(start, at_ - start);
    if (name.empty()) throw std::logic_error("no name in " + text_);
    Skip();
    return name;
  }

  std::string Quoted() {
    std::string result;
    for (++at_; text_.at(at_) != '\''; ++at_) {
      if (text_[at_] == '\\') ++at_;
      result += text_.at(at_);
    }
    ++at_;
    Skip();
    return result;
  }

  Number ReadNumber() {
    const char* start = text_.c_str() + at_;
    char* end = nullptr;
    const double real = std::strtod(start, &end);
    const std::string digits(start, static_cast<std::size_t>(end - start));
    at_ += digits.size();
    Skip();
    constexpr std::size_t kMaxDigits = 30;  // the number of digits that Integer can hold
    if (digits.size() > kMaxDigits || digits.find_first_not_of("0123456789") != std::string::npos) {
      return {false, 0, real};
    }
    Integer whole = 0;
    for (const char digit : digits) whole = whole * 10 + (digit - '0');
    const Number number = Whole(whole);
    return number.integer ? number : Number{false, 0, real};
  }

  const std::string& text_;
  const PropertyList& offer_;
  std::size_t at_ = 0;
};

}  // namespace

bool NaivelyMatches(const std::string& text, const PropertyList& offer) {
  try {
    return Reader(text, offer).Constraint();
  } catch (const NoValue&) {
    return false;
  }
}

}  // namespace gsv::broker
