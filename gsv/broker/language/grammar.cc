// The grammar of the OMG constraint language: OMG Trading Object Service (formal/00-06-27), annex
// B. Each rule has the name of the standard's production, which is quoted beside it.
#include <charconv>
#include <cmath>

#include <tao/pegtl.hpp>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/names.h"

namespace gsv::broker {
namespace {

namespace peg = tao::pegtl;

// ---- Lexical elements

struct Space : peg::star<peg::one<' ', '\t', '\r', '\n'>> {};

struct Letter : peg::sor<peg::alpha, peg::ranges<'\xC0', '\xD6', '\xD8', '\xF6', '\xF8', '\xFF'>> {
};
struct Follow : peg::sor<Letter, peg::digit, peg::one<'_'>> {};

template <typename Rule>
struct Token : peg::seq<Rule, Space> {};
template <typename Word>
struct Keyword : Token<peg::seq<Word, peg::not_at<Follow>>> {};

struct And : Keyword<TAO_PEGTL_STRING("and")> {};
struct Or : Keyword<TAO_PEGTL_STRING("or")> {};
struct Not : Keyword<TAO_PEGTL_STRING("not")> {};
struct In : Keyword<TAO_PEGTL_STRING("in")> {};
struct Exist : Keyword<TAO_PEGTL_STRING("exist")> {};
struct True : Keyword<TAO_PEGTL_STRING("TRUE")> {};
struct False : Keyword<TAO_PEGTL_STRING("FALSE")> {};
struct Reserved : peg::sor<And, Or, Not, In, Exist, True, False> {};

// <Ident> := <Leader> <FollowSeq>
struct IdentText : peg::seq<peg::not_at<Reserved>, Letter, peg::star<Follow>> {};
struct Ident : Token<IdentText> {};

// <Number> := <Mantissa> | <Mantissa> <Exponent>
// <Mantissa> := <Digits> | <Digits> . | . <Digits> | <Digits> . <Digits>
// <Exponent> := <Exp> <Sign> <Digits>
struct Digits : peg::plus<peg::digit> {};
struct Mantissa : peg::sor<peg::seq<Digits, peg::opt<peg::one<'.'>, peg::opt<Digits>>>,
                           peg::seq<peg::one<'.'>, Digits>> {};
struct Exponent : peg::seq<peg::one<'E', 'e'>, peg::opt<peg::one<'+', '-'>>, Digits> {};
struct NumberText : peg::seq<Mantissa, peg::opt<Exponent>, peg::not_at<Follow>> {};
struct NumberLiteral : Token<NumberText> {};
struct NegativeNumber : peg::seq<Token<peg::one<'-'>>, NumberLiteral> {};

// <String> := ' <TChars> ', where <Special> := \\ | \'
struct Special : peg::if_must<peg::one<'\\'>, peg::one<'\\', '\''>> {};
struct Other
    : peg::seq<peg::not_at<peg::one<'\'', '\\', '\x7F'>>, peg::not_at<peg::range<'\x00', '\x08'>>,
               peg::not_at<peg::range<'\x0A', '\x1F'>>, peg::any> {};
struct TChar : peg::sor<Special, Other> {};
struct StringText : peg::star<TChar> {};
struct CloseQuote : peg::one<'\''> {};
struct String : Token<peg::if_must<peg::one<'\''>, StringText, CloseQuote>> {};

struct Open : Token<peg::one<'('>> {};
struct Close : Token<peg::one<')'>> {};

struct Equal : Token<TAO_PEGTL_STRING("==")> {};
struct NotEqual : Token<TAO_PEGTL_STRING("!=")> {};
struct LessEqual : Token<TAO_PEGTL_STRING("<=")> {};
struct GreaterEqual : Token<TAO_PEGTL_STRING(">=")> {};
struct Less : Token<peg::one<'<'>> {};
struct Greater : Token<peg::one<'>'>> {};
struct Tilde : Token<peg::one<'~'>> {};
struct Plus : Token<peg::one<'+'>> {};
struct Minus : Token<peg::one<'-'>> {};
struct Times : Token<peg::one<'*'>> {};
struct Over : Token<peg::one<'/'>> {};

// ---- Expressions, the lowest precedence first

struct bool_or;

// <factor> := ( <bool_or> ) | exist <Ident> | <Ident> | <Number> | - <Number> | <String> | TRUE
//             | FALSE
struct Existing : Ident {};
struct Named : Ident {};
struct Parenthesised : peg::if_must<Open, bool_or, Close> {};
struct factor : peg::sor<Parenthesised, peg::if_must<Exist, Existing>, True, False, Named,
                         NumberLiteral, NegativeNumber, String> {};

// <factor_not> := not <factor> | <factor>
struct NotFactor : peg::if_must<Not, factor> {};
struct factor_not : peg::sor<NotFactor, factor> {};

// <term> := <term> * <factor_not> | <term> / <factor_not> | <factor_not>
struct Product : peg::if_must<Times, factor_not> {};
struct Quotient : peg::if_must<Over, factor_not> {};
struct term : peg::seq<factor_not, peg::star<peg::sor<Product, Quotient>>> {};

// <expr> := <expr> + <term> | <expr> - <term> | <term>
struct Sum : peg::if_must<Plus, term> {};
struct Difference : peg::if_must<Minus, term> {};
struct expr : peg::seq<term, peg::star<peg::sor<Sum, Difference>>> {};

// <expr_twiddle> := <expr> ~ <expr> | <expr>
struct Substring : peg::if_must<Tilde, expr> {};
struct expr_twiddle : peg::seq<expr, peg::opt<Substring>> {};

// <expr_in> := <expr_twiddle> in <Ident> | <expr_twiddle>
struct Containing : Ident {};
struct expr_in : peg::seq<expr_twiddle, peg::opt<peg::if_must<In, Containing>>> {};

// <bool_compare> := <expr_in> == <expr_in> | … != … | … < … | … <= … | … > … | … >= … | <expr_in>
struct IsEqual : peg::if_must<Equal, expr_in> {};
struct IsNotEqual : peg::if_must<NotEqual, expr_in> {};
struct IsLessEqual : peg::if_must<LessEqual, expr_in> {};
struct IsGreaterEqual : peg::if_must<GreaterEqual, expr_in> {};
struct IsLess : peg::if_must<Less, expr_in> {};
struct IsGreater : peg::if_must<Greater, expr_in> {};
struct bool_compare
    : peg::seq<
          expr_in,
          peg::opt<peg::sor<IsEqual, IsNotEqual, IsLessEqual, IsGreaterEqual, IsLess, IsGreater>>> {
};

// <bool_and> := <bool_and> and <bool_compare> | <bool_compare>
struct Conjunction : peg::if_must<And, bool_compare> {};
struct bool_and : peg::seq<bool_compare, peg::star<Conjunction>> {};

// <bool_or> := <bool_or> or <bool_and> | <bool_and>
struct Disjunction : peg::if_must<Or, bool_and> {};
struct bool_or : peg::seq<bool_and, peg::star<Disjunction>> {};

struct EndOfText : peg::eof {};

// <ConstraintExpr> := /* empty */ | <bool>
struct ConstraintExpr
    : peg::must<Space, peg::sor<peg::eof, peg::seq<bool_or, peg::must<EndOfText>>>> {};

// <Preference> := /* empty */ | min <bool> | max <bool> | with <bool> | random | first
struct Min : Keyword<TAO_PEGTL_STRING("min")> {};
struct Max : Keyword<TAO_PEGTL_STRING("max")> {};
struct With : Keyword<TAO_PEGTL_STRING("with")> {};
struct Random : Keyword<TAO_PEGTL_STRING("random")> {};
struct First : Keyword<TAO_PEGTL_STRING("first")> {};
struct PreferenceBody : peg::sor<peg::if_must<Min, bool_or>, peg::if_must<Max, bool_or>,
                                 peg::if_must<With, bool_or>, Random, First, peg::at<peg::eof>> {};
struct PreferenceExpr : peg::must<Space, PreferenceBody, EndOfText> {};

// ---- Building the tree

struct Building {
  const ExpressionLimits& limits;
  Expression expression{};
  std::vector<std::size_t> operands{};  // indices of nodes that no operator uses yet
  std::size_t depth = 0;
  Preference::Kind preference = Preference::Kind::kFirst;

  template <typename Input>
  void Add(const Input& in, Node node) {
    if (expression.nodes.size() >= limits.nodes) {
      throw peg::parse_error("the expression has more than " + std::to_string(limits.nodes) +
                                 " operators, properties and literals",
                             in);
    }
    node.position = in.position().byte;
    operands.push_back(expression.nodes.size());
    expression.nodes.push_back(std::move(node));
  }

  std::size_t TakeOperand() {
    const std::size_t operand = operands.back();
    operands.pop_back();
    return operand;
  }

  template <typename Input>
  void AddLiteral(const Input& in, ScalarValue value) {
    Node node;
    node.literal = std::move(value);
    Add(in, std::move(node));
  }

  template <typename Input>
  void AddProperty(const Input& in, Operator op) {
    const std::string text = in.string();
    Node node;
    node.op = op;
    node.property = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    if (op == Operator::kIn) node.left = TakeOperand();
    Add(in, std::move(node));
  }

  template <typename Input>
  void AddUnary(const Input& in, Operator op) {
    Node node;
    node.op = op;
    node.left = TakeOperand();
    Add(in, std::move(node));
  }

  template <typename Input>
  void AddBinary(const Input& in, Operator op) {
    Node node;
    node.op = op;
    node.right = TakeOperand();
    node.left = TakeOperand();
    Add(in, std::move(node));
  }
};

// Converts a literal to an integer if its text is an integer that fits into 64 bits, else to a
// double.
template <typename Input>
ScalarValue ToNumber(const Input& in) {
  const std::string text = in.string();
  std::int64_t integer = 0;
  const char* const end = text.data() + text.size();
  const auto whole = std::from_chars(text.data(), end, integer);
  if (whole.ec == std::errc() && whole.ptr == end) return integer;
  double real = 0;
  if (std::from_chars(text.data(), end, real).ec != std::errc()) {
    throw peg::parse_error("the number " + text + " is out of a double's range", in);
  }
  return real;
}

ScalarValue Negated(const ScalarValue& number) {
  if (const auto* integer = std::get_if<std::int64_t>(&number)) return -*integer;
  return -std::get<double>(number);
}

std::string Unescaped(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\') ++i;
    plain.push_back(text[i]);
  }
  return plain;
}

template <typename Rule>
struct Action : peg::nothing<Rule> {};

template <Operator kOperator>
struct AddsBinary {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    building.AddBinary(in, kOperator);
  }
};

template <Operator kOperator>
struct AddsProperty {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    building.AddProperty(in, kOperator);
  }
};

template <bool kValue>
struct AddsTruth {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    building.AddLiteral(in, kValue);
  }
};

template <Preference::Kind kKind>
struct SetsPreference {
  static void apply0(Building& building) { building.preference = kKind; }
};

// clang-format off: a table
template <>
struct Action<Disjunction> : AddsBinary<Operator::kOr> {};
template <>
struct Action<Conjunction> : AddsBinary<Operator::kAnd> {};
template <>
struct Action<IsEqual> : AddsBinary<Operator::kEqual> {};
template <>
struct Action<IsNotEqual> : AddsBinary<Operator::kNotEqual> {};
template <>
struct Action<IsLess> : AddsBinary<Operator::kLess> {};
template <>
struct Action<IsLessEqual> : AddsBinary<Operator::kLessEqual> {};
template <>
struct Action<IsGreater> : AddsBinary<Operator::kGreater> {};
template <>
struct Action<IsGreaterEqual> : AddsBinary<Operator::kGreaterEqual> {};
template <>
struct Action<Substring> : AddsBinary<Operator::kSubstring> {};
template <>
struct Action<Sum> : AddsBinary<Operator::kAdd> {};
template <>
struct Action<Difference> : AddsBinary<Operator::kSubtract> {};
template <>
struct Action<Product> : AddsBinary<Operator::kMultiply> {};
template <>
struct Action<Quotient> : AddsBinary<Operator::kDivide> {};
template <>
struct Action<Named> : AddsProperty<Operator::kProperty> {};
template <>
struct Action<Existing> : AddsProperty<Operator::kExist> {};
template <>
struct Action<Containing> : AddsProperty<Operator::kIn> {};
template <>
struct Action<True> : AddsTruth<true> {};
template <>
struct Action<False> : AddsTruth<false> {};
template <>
struct Action<Min> : SetsPreference<Preference::Kind::kMin> {};
template <>
struct Action<Max> : SetsPreference<Preference::Kind::kMax> {};
template <>
struct Action<With> : SetsPreference<Preference::Kind::kWith> {};
template <>
struct Action<Random> : SetsPreference<Preference::Kind::kRandom> {};
// clang-format on

template <>
struct Action<NotFactor> {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    building.AddUnary(in, Operator::kNot);
  }
};

template <>
struct Action<NumberText> {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    building.AddLiteral(in, ToNumber(in));
  }
};

template <>
struct Action<NegativeNumber> {
  static void apply0(Building& building) {
    ScalarValue& number = building.expression.nodes.back().literal;
    number = Negated(number);
  }
};

template <>
struct Action<StringText> {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    building.AddLiteral(in, Unescaped(in.string_view()));
    // `in` begins after the opening quote. The position of the literal is that of the quote.
    --building.expression.nodes.back().position;
  }
};

template <>
struct Action<Open> {
  template <typename Input>
  static void apply(const Input& in, Building& building) {
    if (++building.depth > building.limits.depth) {
      throw peg::parse_error(
          "parentheses are nested deeper than " + std::to_string(building.limits.depth), in);
    }
  }
};

template <>
struct Action<Close> {
  static void apply0(Building& building) { --building.depth; }
};

// ---- Descriptions of what was expected

template <typename Rule>
constexpr const char* kExpected = "an operand (a property, a literal, 'exist', 'not' or '(')";
template <>
constexpr const char* kExpected<Close> = "')'";
template <>
constexpr const char* kExpected<CloseQuote> = "a closing quote";
template <>
constexpr const char* kExpected<peg::one<'\\', '\''>> = "\\' or \\\\ (the only escapes)";
template <>
constexpr const char* kExpected<Existing> = "a property's name after 'exist'";
template <>
constexpr const char* kExpected<Containing> = "a property's name after 'in'";
template <>
constexpr const char* kExpected<EndOfText> = "an operator or the end";
template <>
constexpr const char* kExpected<PreferenceBody> = "'min', 'max', 'with', 'random' or 'first'";

template <typename Rule>
struct Control : peg::normal<Rule> {
  template <typename Input, typename... States>
  [[noreturn]] static void raise(const Input& in, States&&...) {
    throw peg::parse_error(std::string("expected ") + kExpected<Rule>, in);
  }
};

base::Error Refusal(std::size_t byte, std::string_view what) {
  return base::Error{base::ErrorCode::kInvalidArgument, std::string(what),
                     "character " + std::to_string(byte + 1)};
}

template <typename Grammar>
base::Status Parse(std::string_view text, Building& building) {
  if (text.size() > building.limits.length) {
    return base::Fail(Refusal(
        building.limits.length,
        "the text is longer than " + std::to_string(building.limits.length) + " characters"));
  }
  peg::memory_input<peg::tracking_mode::eager, peg::eol::lf> in(text.data(), text.size(), "");
  try {
    peg::parse<Grammar, Action, Control>(in, building);
  } catch (const peg::parse_error& error) {
    return base::Fail(Refusal(error.positions().front().byte, error.message()));
  }
  return {};
}

}  // namespace

base::Result<Expression> ParseConstraint(std::string_view text, const ExpressionLimits& limits) {
  Building building{limits};
  if (auto parsed = Parse<ConstraintExpr>(text, building); !parsed) {
    return base::Fail(parsed.error());
  }
  if (building.expression.nodes.empty()) {
    building.expression.nodes.push_back({.literal = true});
  }
  return std::move(building.expression);
}

base::Result<Preference> ParsePreference(std::string_view text, const ExpressionLimits& limits) {
  Building building{limits};
  if (auto parsed = Parse<PreferenceExpr>(text, building); !parsed) {
    return base::Fail(parsed.error());
  }
  return Preference{building.preference, std::move(building.expression)};
}

}  // namespace gsv::broker
