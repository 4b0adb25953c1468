#include "gsv/formats/xacro/evaluation.h"

#include <gmock/gmock.h>

namespace gsv::formats::xacro {
namespace {

using testing::HasSubstr;

EvaluationContext EmptyContext() {
  EvaluationContext context;
  context.property = [](const std::string& name) -> base::Result<std::optional<Value>> {
    if (name == "side") return Value{std::string("left")};
    return std::nullopt;
  };
  return context;
}

std::string TextOf(const std::string& expression) {
  const auto value = Evaluate(expression, EmptyContext());
  return value ? ToText(*value) : "refused: " + value.error().message;
}

// Python 3.11 prints these values for the same expressions.
TEST(Evaluation, EqualsPython) {
  const std::pair<const char*, const char*> cases[] = {
      {"1 + 2 * 3", "7"},
      {"7 / 2", "3.5"},
      {"7 // 2", "3"},
      {"-7 // 2", "-4"},
      {"-7 % 3", "2"},
      {"7.5 % -2", "-0.5"},
      {"2 ** 10", "1024"},
      {"2 ** -1", "0.5"},
      {"2.0 ** 0.5", "1.4142135623730951"},
      {"-2 ** 2", "-4"},
      {"1 if 2 > 1 else 0", "1"},
      {"'a' + 'b' * 3", "abbb"},
      {"1 < 2 < 3", "True"},
      {"1 < 3 < 2", "False"},
      {"not 0 or 5", "True"},
      {"0 or 'x'", "x"},
      {"3 and 4", "4"},
      {"'us' in 'use'", "True"},
      {"2 not in [1, 3]", "True"},
      {"[1, 2, 3][-1]", "3"},
      {"(1, 2)", "(1, 2)"},
      {"{'a': 1, 'b': [2.0]}", "{'a': 1, 'b': [2.0]}"},
      {"0.1 + 0.2", "0.30000000000000004"},
      {"1e16", "1e+16"},
      {"1e15", "1000000000000000.0"},
      {"1e-4", "0.0001"},
      {"1e-5", "1e-05"},
      {"1.0", "1.0"},
      {"100000000000000000000.0", "1e+20"},
      {"abs(-3)", "3"},
      {"max(1, 2.5)", "2.5"},
      {"min([3, 1, 2])", "1"},
      {"round(2.675, 2)", "2.67"},
      {"round(2.5)", "2"},
      {"round(125, -1)", "120"},
      {"round(135, -1)", "140"},
      {"round(-126, -1)", "-130"},
      {"round(1250.0, -2)", "1200.0"},
      {"round(1250.5, -2)", "1300.0"},
      {"round(49, -2)", "0"},
      {"round(3.7)", "4"},
      {"len('abc')", "3"},
      {"int('7') + int(2.9)", "9"},
      {"float('1e3')", "1000.0"},
      {"str(1.50)", "1.5"},
      {"'Left'.lower()", "left"},
      {"'a b c'.split()", "['a', 'b', 'c']"},
      {"'x.y'.replace('.', '_')", "x_y"},
      {"', '.join(['a', 'b'])", "a, b"},
      {"'%.2f' % 1.5", "1.50"},
      {"'%s_%02d' % ('leg', 3)", "leg_03"},
      {"'%+d|%-4s|%4d|%05.1f|%%' % (2, 'a', 7, -2.25)", "+2|a   |   7|-02.2|%"},
      {"'%g' % 0.5", "0.5"},
      {"'abc'[1:]", "bc"},
      {"[1, 2, 3][:2]", "[1, 2]"},
      {"True", "True"},
      {"None", "None"},
      {"1 == 1.0", "True"},
      {"'1' == 1", "False"},
      {"-0.0", "-0.0"},
      {"1_000 * 2", "2000"},
      {"3 * 0.1", "0.30000000000000004"},
      {"int(-2.7)", "-2"},
      {"{'k': {'m': 4}}['k']['m']", "4"},
      {"dict(a=1, b=2)", "{'a': 1, 'b': 2}"},
      {"0.9 / 2 - 0.2", "0.25"},
      {"5 - -3", "8"},
      {"2 if False else 3 if False else 4", "4"},
      {"(1,)", "(1,)"},
      {"()", "()"},
      {"bool('')", "False"},
      {"sum([1, 2.5])", "3.5"},
      {"1.0 // 0.3", "3.0"},
      {"list((1, 2))", "[1, 2]"},
      {"radians(90)", "1.5707963267948966"},
      {"sin(pi / 2)", "1.0"},
      {"cos(0)", "1.0"},
      {"sqrt(2)", "1.4142135623730951"},
      {"atan2(1, 1)", "0.7853981633974483"},
      {"degrees(pi)", "180.0"},
      {"pow(2, 3)", "8.0"},
      {"hypot(3, 4)", "5.0"},
      {"floor(-2.5)", "-3"},
      {"ceil(2.1)", "3"},
      {"math.pi / 4", "0.7853981633974483"},
      {"exp(1)", "2.718281828459045"},
      {"log(8, 2)", "3.0"},
      {"fabs(-2)", "2.0"},
      {"range(1, 8, 3)", "[1, 4, 7]"},
      {"len(range(3))", "3"},
      {"sorted([2, 1.5, 3])", "[1.5, 2, 3]"},
      {"list(reversed([1, 2]))", "[2, 1]"},
      {"list(enumerate(['a']))", "[(0, 'a')]"},
      {"list(zip([1, 2], ['a', 'b', 'c']))", "[(1, 'a'), (2, 'b')]"},
      {"any([0, 1])", "True"},
      {"all([0, 1])", "False"},
      {"'{}_{:.2f}'.format('a', 1.239)", "a_1.24"},
      {"'{1}{0}'.format('a', 'b')", "ba"},
      {"'{{}}'.format()", "{}"},
      {"'-7'.zfill(4)", "-007"},
      {"'aBc'.capitalize()", "Abc"},
      {"'12'.isdigit()", "True"},
      {"'abc'.find('c')", "2"},
      {"tan(radians(45))", "0.9999999999999999"},
  };
  for (const auto& [expression, expected] : cases) {
    EXPECT_EQ(TextOf(expression), expected) << expression;
  }
}

TEST(Evaluation, KnowsProperties) {
  EXPECT_EQ(TextOf("side + '_wheel'"), "left_wheel");
  EXPECT_EQ(TextOf("1 if side == 'left' else -1"), "1");
  EXPECT_EQ(TextOf("1 if True else unknown"), "1");
}

TEST(Evaluation, RejectsInvalidExpressionsWithTheReason) {
  const std::pair<const char*, const char*> cases[] = {
      {"unknown + 1", "\"unknown\" is not defined"},
      {"1 / 0", "division by zero"},
      {"1 % 0", "division by zero"},
      {"'a' + 1", "\"+\" does not take str and int"},
      {"'a' < 1", "\"<\" does not take str and int"},
      {"[1, 2][5]", "the index 5 is out of range"},
      {"sqrt(-1)", "sqrt() is not defined for -1"},
      {"9223372036854775807 + 1", "beyond 64 bits"},
      {"open('x')", "the call of open() is not supported"},
      {"__import__('os')", "the call of __import__() is not supported"},
      {"side.__class__", "a str has no \"__class__\""},
      {"'{:d}'.format(1)", "the format \"d\" is not supported"},
      {"side.title()", "the string method title() is not supported"},
      {"[x for x in [1]]", "comprehensions are not supported"},
      {"lambda: 1", "lambda is not supported"},
      {"f'{side}'", "strings with a prefix"},
      {"1 +", "ends too early"},
      {"(1", "\")\" is missing"},
      {"'a", "a string does not end"},
      {"1 2", "\"2\" is not expected here"},
      {"", "ends too early"},
      {"1 & 2", "\"&\" is not supported"},
      {"'a' * 10000000", "a string is longer than 1 MiB"},
      {"[0] * 10000000", "a list has more than 10000 values"},
  };
  for (const auto& [expression, expected] : cases) {
    EXPECT_THAT(TextOf(expression), HasSubstr(expected)) << expression;
  }
}

TEST(Evaluation, RefusesExpressionsNestedTooDeeply) {
  const std::string brackets(5000, '(');
  EXPECT_THAT(TextOf(brackets + "1"), HasSubstr("refused"));
  EXPECT_THAT(TextOf(std::string(3000, '-') + "1"), HasSubstr("nested deeper than 64"));
  EXPECT_THAT(TextOf(std::string(3000, '[') + std::string(3000, ']')), HasSubstr("refused"));
  std::string powers = "1";
  for (int i = 0; i < 1000; ++i) powers += "**1";
  EXPECT_THAT(TextOf(powers), HasSubstr("nested deeper than 64"));
}

TEST(Evaluation, ReadsLiteralsAsXacroDoes) {
  const std::pair<const char*, const char*> cases[] = {
      {"2", "int"},      {" 42 ", "int"},  {"2.0", "float"}, {"1e3", "float"}, {"true", "bool"},
      {"False", "bool"}, {"1_000", "str"}, {"'2'", "str"},   {"left", "str"},  {"5 -2", "str"},
  };
  for (const auto& [text, type] : cases) EXPECT_STREQ(TypeName(FromLiteral(text)), type) << text;
}

}  // namespace
}  // namespace gsv::formats::xacro
