#include "gsv/broker/language/type_check.h"

#include <map>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

const std::map<std::string_view, PropertyType> kDeclared = {
    {"cost", {.scalar = Scalar::kDouble}},
    {"ppm", {.scalar = Scalar::kUShort}},
    {"name", {.scalar = Scalar::kString}},
    {"grade", {.scalar = Scalar::kChar}},
    {"colour", {.scalar = Scalar::kBoolean}},
    {"paper", {.scalar = Scalar::kString, .sequence = true}},
    {"grades", {.scalar = Scalar::kChar, .sequence = true}},
    {"place", {.scalar = Scalar::kOther, .name = "struct IDL:acme/Place:1.0"}},
};

std::optional<PropertyType> Declared(std::string_view name) {
  const auto found = kDeclared.find(name);
  return found != kDeclared.end() ? std::optional(found->second) : std::nullopt;
}

std::string Verdict(std::string_view text) {
  const base::Status status = CheckConstraintTypes(*ParseConstraint(text, {}), Declared);
  return status ? "fits" : status.error().Sentence();
}

TEST(TypeCheck, AcceptsOperandsOfTheRightTypes) {
  for (const char* text :
       {"cost < 3 and ppm >= 10", "name == 'x' or 'x' ~ name", "colour and not (ppm == 1)",
        "'A4' in paper", "'x' in grades", "grade in grades", "grade == 'A'", "'A' == grade",
        "unknown == name or unknown > 3", "unknown", "1 in unknown", "exist place and exist paper",
        "cost + ppm * 2 > unknown"}) {
    EXPECT_EQ(Verdict(text), "fits") << text;
  }
}

TEST(TypeCheck, RejectsOperandsThatCannotHaveTheRightTypes) {
  const std::pair<const char*, const char*> kCases[] = {
      {"name > 3",
       "character 6: '>': its operands are a string and a number, which cannot be compared"},
      {"colour == 1",
       "character 8: '==': its operands are a boolean and a number, which cannot be compared"},
      {"paper == paper",
       "character 7: '==': its operands are a sequence and a sequence, which cannot be compared"},
      {"name == grade",
       "character 6: '==': its operands are a string and a char, which cannot be compared"},
      {"place == place",
       "character 7: '==': its operands are a value of a type that only 'exist' supports and a "
       "value of a type that only 'exist' supports, which cannot be compared"},
      {"name + 1 == 2", "character 6: '+': it needs a number, and its operand is a string"},
      {"not ppm", "character 1: 'not': it needs a boolean, and its operand is a number"},
      {"colour and cost", "character 8: 'and': it needs a boolean, and its operand is a number"},
      {"ppm ~ name", "character 5: '~': it needs a string, and its operand is a number"},
      {"'a' ~ grade", "character 5: '~': it needs a string, and its operand is a char"},
      {"paper in unknown", "character 10: 'in': no sequence can contain a sequence"},
      {"place in unknown",
       "character 10: 'in': no sequence can contain a value of a type that only 'exist' supports"},
      {"'a' in name",
       "character 8: 'in': the property name is string, not a sequence of a simple type"},
      {"1 in paper",
       "character 6: 'in': the property paper is sequence<string>, which cannot contain a number"},
      {"cost + 1", "character 6: a constraint must be a boolean, not a number"},
      {"'text'", "character 1: a constraint must be a boolean, not a string"},
  };
  for (const auto& [text, expected] : kCases) EXPECT_EQ(Verdict(text), expected) << text;
}

TEST(TypeCheck, RequiresAnOrderedTypeForAPreference) {
  const auto fits = [](std::string_view text) {
    return CheckPreferenceTypes(*ParsePreference(text, {}), Declared).has_value();
  };
  EXPECT_TRUE(fits("min cost"));
  EXPECT_TRUE(fits("max unknown"));
  EXPECT_TRUE(fits("with colour"));
  EXPECT_TRUE(fits("first"));
  EXPECT_FALSE(fits("min name"));
  EXPECT_FALSE(fits("max colour"));
  EXPECT_FALSE(fits("with cost"));
}

}  // namespace
}  // namespace gsv::broker
