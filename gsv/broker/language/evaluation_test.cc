#include "gsv/broker/language/evaluation.h"

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

const PropertyList kOffer({
    {"cost", Value::Double(2.5)},
    {"ppm", Value::UShort(12)},
    {"floor", Value::Long(-3)},
    {"seven", Value::ULong(7)},
    {"third", Value::Float(0.1f)},
    {"name", Value::String("laser printer")},
    {"grade", Value::Char('A')},
    {"colour", Value::Boolean(true)},
    {"paper", Value::Strings({"A4", "letter"})},
    {"trays", Value::SequenceOf(Scalar::kLong, {std::int64_t{1}, std::int64_t{3}})},
    {"nothing", Value::Strings({})},
    {"place", Value::Other({"struct IDL:acme/Place:1.0", "…"})},
});

bool Holds(std::string_view text) {
  const auto constraint = ParseConstraint(text, {});
  EXPECT_TRUE(constraint) << text;
  return constraint && Matches(*constraint, kOffer);
}

TEST(Evaluation, ComparesWithNumericPromotion) {
  const std::pair<const char*, bool> kCases[] = {
      {"ppm == 12", true},    {"ppm == 12.0", true},
      {"cost == 2.5", true},  {"cost < 3", true},
      {"floor < ppm", true},  {"floor >= -3", true},
      {"cost != 2.5", false}, {"ppm > 12", false},
      {"ppm <= 12", true},    {"third == 0.1", false},
      {"third > 0.1", true},  {"9007199254740993 == 9007199254740992.0", false},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Holds(text), expected) << text;
}

TEST(Evaluation, ComparesStringsAndBooleans) {
  const std::pair<const char*, bool> kCases[] = {
      {"name == 'laser printer'", true},
      {"name < 'line'", true},
      {"grade == 'A'", true},
      {"grade < 'B'", true},
      {"colour", true},
      {"colour == TRUE", true},
      {"not colour", false},
      {"colour != FALSE", true},
      {"FALSE < TRUE", true},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Holds(text), expected) << text;
}

TEST(Evaluation, CalculatesIntegersExactlyAndTruncatesQuotients) {
  const std::pair<const char*, bool> kCases[] = {
      {"1 + 2 * 3 == 7", true},
      {"(1 + 2) * 3 == 9", true},
      {"seven / 2 == 3", true},
      {"-7 / 2 == -3", true},
      {"seven / 2.0 == 3.5", true},
      {"10 - 2 - 3 == 5", true},
      {"floor * ppm == -36", true},
      {"cost * 2 == 5", true},
      {"9223372036854775807 + 1 == 9223372036854775808.0", true},
      {"4611686018427387904 * 4 > 9223372036854775807", true},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Holds(text), expected) << text;
}

TEST(Evaluation, SubstringOperatorFindsTheLeftStringInTheRight) {
  EXPECT_TRUE(Holds("'laser' ~ name"));
  EXPECT_TRUE(Holds("'' ~ name"));
  EXPECT_TRUE(Holds("name ~ name"));
  EXPECT_FALSE(Holds("name ~ 'laser'"));
  EXPECT_FALSE(Holds("'Laser' ~ name")) << "case matters";
}

TEST(Evaluation, FindsElementsInSequences) {
  EXPECT_TRUE(Holds("'A4' in paper"));
  EXPECT_FALSE(Holds("'A3' in paper"));
  EXPECT_TRUE(Holds("1 + 2 in trays"));
  EXPECT_TRUE(Holds("3.0 in trays"));
  EXPECT_FALSE(Holds("2 in trays"));
  EXPECT_FALSE(Holds("'A4' in nothing"));
  EXPECT_TRUE(Holds("not ('A4' in nothing)")) << "an empty sequence is a sequence";
}

TEST(Evaluation, ExistOperatorIsTrueForPropertiesOfTheOffer) {
  EXPECT_TRUE(Holds("exist cost"));
  EXPECT_TRUE(Holds("exist place")) << "of any type";
  EXPECT_FALSE(Holds("exist weight"));
  EXPECT_TRUE(Holds("not exist weight"));
}

TEST(Evaluation, ConstraintIsFalseIfAPropertyIsMissing) {
  EXPECT_FALSE(Holds("weight > 3"));
  EXPECT_FALSE(Holds("not (weight > 3)"));
  EXPECT_FALSE(Holds("weight > 3 or colour"));
  EXPECT_FALSE(Holds("weight + 1 == weight + 1"));
  EXPECT_FALSE(Holds("'A4' in weight"));
  EXPECT_FALSE(Holds("not ('A4' in weight)"));
}

TEST(Evaluation, StopsWhenTheResultIsKnown) {
  EXPECT_TRUE(Holds("colour or weight > 3"));
  EXPECT_TRUE(Holds("not (exist weight and weight > 3)"));
  EXPECT_TRUE(Holds("not exist weight or weight > 3"));
}

TEST(Evaluation, ConstraintIsFalseIfTypesDoNotFit) {
  EXPECT_FALSE(Holds("name > 3"));
  EXPECT_FALSE(Holds("not (name > 3)"));
  EXPECT_FALSE(Holds("place == place"));
  EXPECT_FALSE(Holds("paper == paper"));
  EXPECT_FALSE(Holds("'A4' in name"));
  EXPECT_FALSE(Holds("1 in paper"));
  EXPECT_FALSE(Holds("name + 1 == 1"));
  EXPECT_FALSE(Holds("cost"));
  EXPECT_FALSE(Holds("1 ~ name"));
}

TEST(Evaluation, ConstraintIsFalseIfItDividesByZero) {
  EXPECT_FALSE(Holds("1 / 0 == 1"));
  EXPECT_FALSE(Holds("not (1 / 0 == 1)"));
  EXPECT_FALSE(Holds("1.5 / (ppm - 12) > 0"));
}

TEST(Evaluation, ReturnsTheNumberOfAPreference) {
  const auto number = [](std::string_view text) {
    return EvaluateNumber(*ParseConstraint(text, {}), kOffer);
  };
  EXPECT_EQ(number("2 * cost"), 5.0L);
  EXPECT_EQ(number("floor"), -3.0L);
  EXPECT_EQ(number("weight"), std::nullopt);
  EXPECT_EQ(number("name"), std::nullopt);
}

}  // namespace
}  // namespace gsv::broker
