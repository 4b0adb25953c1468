#include <gtest/gtest.h>

#include "gsv/broker/language/expression.h"

namespace gsv::broker {
namespace {

constexpr ExpressionLimits kLimits{.length = 400, .depth = 4, .nodes = 20};

// Returns the expression in prefix notation, with parentheses around the operands of every
// operator.
std::string ToPrefix(const Expression& expression, const Node& node) {
  const auto operand = [&](std::size_t index) {
    return ToPrefix(expression, expression.nodes[index]);
  };
  switch (node.op) {
    case Operator::kLiteral:
      if (const auto* truth = std::get_if<bool>(&node.literal)) return *truth ? "TRUE" : "FALSE";
      if (const auto* integer = std::get_if<std::int64_t>(&node.literal)) {
        return std::to_string(*integer);
      }
      if (const auto* real = std::get_if<double>(&node.literal)) {
        return std::to_string(*real) + "d";
      }
      return "'" + std::get<std::string>(node.literal) + "'";
    case Operator::kProperty:
      return node.property;
    case Operator::kExist:
      return "exist(" + node.property + ")";
    case Operator::kNot:
      return "not(" + operand(node.left) + ")";
    case Operator::kIn:
      return "in(" + operand(node.left) + " " + node.property + ")";
    default:
      return std::string(Spelling(node.op)) + "(" + operand(node.left) + " " + operand(node.right) +
             ")";
  }
}

std::string Parsed(std::string_view text) {
  const auto expression = ParseConstraint(text, kLimits);
  return expression ? ToPrefix(*expression, expression->root()) : expression.error().Sentence();
}

TEST(Grammar, FollowsTheStandardsPrecedence) {
  const std::pair<const char*, const char*> kCases[] = {
      {"a or b and c", "or(a and(b c))"},
      {"a and b or c", "or(and(a b) c)"},
      {"a or b or c", "or(or(a b) c)"},
      {"(a or b) and c", "and(or(a b) c)"},
      {"a == 1 and b != 2", "and(==(a 1) !=(b 2))"},
      {"a < 1 or b <= 2", "or(<(a 1) <=(b 2))"},
      {"a > 1 or b >= 2", "or(>(a 1) >=(b 2))"},
      {"1 + 2 * 3", "+(1 *(2 3))"},
      {"1 * 2 + 3", "+(*(1 2) 3)"},
      {"1 - 2 - 3", "-(-(1 2) 3)"},
      {"8 / 4 / 2", "/(/(8 4) 2)"},
      {"not a and b", "and(not(a) b)"},
      {"not a == b", "==(not(a) b)"},
      {"not (a == b)", "not(==(a b))"},
      {"'x' in names == TRUE", "==(in('x' names) TRUE)"},
      {"'a' ~ 'b' in names", "in(~('a' 'b') names)"},
      {"1 + 2 in numbers", "in(+(1 2) numbers)"},
      {"'a' ~ name or exist b", "or(~('a' name) exist(b))"},
      {"exist a and a > -1", "and(exist(a) >(a -1))"},
      {"3-2", "-(3 2)"},
      {"3 - -2", "-(3 -2)"},
      {"((((a))))", "a"},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Parsed(text), expected) << text;
}

TEST(Grammar, ReadsLiteralsOfEveryForm) {
  const std::pair<const char*, const char*> kCases[] = {
      {"42", "42"},
      {"- 42", "-42"},
      {"1.5", "1.500000d"},
      {"1.", "1.000000d"},
      {".5", "0.500000d"},
      {"1E3", "1000.000000d"},
      {"25e-1", "2.500000d"},
      {"1e+2", "100.000000d"},
      {"9223372036854775807", "9223372036854775807"},
      {"9223372036854775808", "9223372036854775808.000000d"},
      {"TRUE", "TRUE"},
      {"FALSE", "FALSE"},
      {"'plain'", "'plain'"},
      {"''", "''"},
      {R"('it\'s')", "'it's'"},
      {R"('a\\b')", R"('a\b')"},
      {"'and (or)'", "'and (or)'"},
      {"  \t\r\n 7 \n", "7"},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Parsed(text), expected) << text;
}

TEST(Grammar, DistinguishesKeywordsFromNamesThatBeginLikeThem) {
  EXPECT_EQ(Parsed("order or android"), "or(order android)");
  EXPECT_EQ(Parsed("not notes"), "not(notes)");
  EXPECT_EQ(Parsed("exist existing"), "exist(existing)");
  EXPECT_EQ(Parsed("in1 == TRUEST"), "==(in1 TRUEST)");
  EXPECT_EQ(Parsed("a_b1 and B"), "and(a_b1 B)");
  EXPECT_EQ(Parsed("\xE9t\xE9 == 1"), "==(\xE9t\xE9 1)") << "Latin-1 letters are letters";
}

TEST(Grammar, EmptyTextIsTrue) {
  EXPECT_EQ(Parsed(""), "TRUE");
  EXPECT_EQ(Parsed("  \n"), "TRUE");
}

TEST(Grammar, ReportsTheExpectedTokenAndItsPosition) {
  constexpr const char* kOperand =
      "expected an operand (a property, a literal, 'exist', 'not' or '(')";
  const std::pair<const char*, std::string> kCases[] = {
      {"a ==", std::string("character 5: ") + kOperand},
      {"a and", std::string("character 6: ") + kOperand},
      {"== 1", std::string("character 1: ") + kOperand},
      {"a = 1", "character 3: expected an operator or the end"},
      {"a b", "character 3: expected an operator or the end"},
      {"a < b < c", "character 7: expected an operator or the end"},
      {"(a", "character 3: expected ')'"},
      {"a)", "character 2: expected an operator or the end"},
      {"not not a", std::string("character 5: ") + kOperand},
      {"-a", std::string("character 1: ") + kOperand},
      {"'open", "character 6: expected a closing quote"},
      {R"('a\nb')", "character 4: expected \\' or \\\\ (the only escapes)"},
      {"exist 'a'", "character 7: expected a property's name after 'exist'"},
      {"1 in 2", "character 6: expected a property's name after 'in'"},
      {"1 in (a)", "character 6: expected a property's name after 'in'"},
      {"a AND b", "character 3: expected an operator or the end"},
      {"12abc", std::string("character 1: ") + kOperand},
      {"1e999", "character 1: the number 1e999 is out of a double's range"},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Parsed(text), expected) << text;
}

TEST(Grammar, RejectsExpressionsBeyondTheLimits) {
  EXPECT_EQ(Parsed("((((a))))"), "a");
  EXPECT_EQ(Parsed("(((((a)))))"), "character 5: parentheses are nested deeper than 4");
  EXPECT_EQ(Parsed("(a) or (b) or (c) or (d) or (e) or (f)"), "or(or(or(or(or(a b) c) d) e) f)")
      << "what is closed does not count";
  EXPECT_EQ(Parsed(std::string(401, ' ')), "character 401: the text is longer than 400 characters");
  EXPECT_EQ(Parsed("1+1+1+1+1+1+1+1+1+1+1"),
            "character 20: the expression has more than 20 operators, properties and literals");
}

TEST(Grammar, ReadsEveryPreference) {
  using Kind = Preference::Kind;
  const std::pair<const char*, Kind> kCases[] = {
      {"", Kind::kFirst},       {"first", Kind::kFirst},       {" random ", Kind::kRandom},
      {"min cost", Kind::kMin}, {"max 2 * speed", Kind::kMax}, {"with a == 1", Kind::kWith},
  };
  for (const auto& [text, kind] : kCases) {
    const auto preference = ParsePreference(text, kLimits);
    ASSERT_TRUE(preference) << text;
    EXPECT_EQ(preference->kind, kind) << text;
    const bool has_expression = kind == Kind::kMin || kind == Kind::kMax || kind == Kind::kWith;
    EXPECT_EQ(preference->expression.nodes.empty(), !has_expression) << text;
  }
}

TEST(Grammar, RejectsInvalidPreferences) {
  EXPECT_EQ(ParsePreference("cheapest", kLimits).error().Sentence(),
            "character 1: expected 'min', 'max', 'with', 'random' or 'first'");
  EXPECT_EQ(ParsePreference("first cost", kLimits).error().Sentence(),
            "character 7: expected an operator or the end");
  EXPECT_EQ(ParsePreference("min", kLimits).error().where, "character 4");
}

}  // namespace
}  // namespace gsv::broker
