#include "gsv/broker/offers/recipe.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/language/expression.h"

namespace gsv::broker {
namespace {

const PropertyList kProperties({{"flag", Value::Boolean(false)},
                                {"letter", Value::Char('\'')},
                                {"n", Value::Long(-7)},
                                {"name", Value::String("o'clock \\ $*")},
                                {"numbers", Value::SequenceOf(Scalar::kLong, {})},
                                {"real", Value::Double(0.1)},
                                {"strange", Value::Double(std::nan(""))}});

TEST(Recipe, InsertsTheConstraintAndTheValues) {
  const auto follow = [](const char* recipe) {
    return FollowRecipe(recipe, kProperties, "a < 1 or $b");
  };
  EXPECT_EQ(follow(""), "");
  EXPECT_EQ(follow("exist x"), "exist x");
  EXPECT_EQ(follow("$*"), "a < 1 or $b");
  EXPECT_EQ(follow("($*) and ($*)"), "(a < 1 or $b) and (a < 1 or $b)");
  EXPECT_EQ(follow("n == $(n)"), "n == -7");
  EXPECT_EQ(follow("real == $(real) and flag == $(flag)"), "real == 0.1 and flag == FALSE");
  EXPECT_EQ(follow("name == $(name) or $(letter)"), "name == 'o\\'clock \\\\ $*' or '\\''");
  EXPECT_EQ(follow("'$$(n)'"), "'$(n)'");
  EXPECT_EQ(follow("x == $(strange)"), std::nullopt) << "NaN has no literal";
}

TEST(Recipe, RejectsInvalidRecipes) {
  for (const char* good : {"", "$*", "$$", "$(n)$(name)$(strange)", "*()"}) {
    EXPECT_TRUE(IsRecipe(good, kProperties)) << good;
  }
  for (const char* bad : {"$", "a == $", "$x", "$(n", "$()", "$(absent)", "$(numbers)", "$( n)"}) {
    EXPECT_FALSE(IsRecipe(bad, kProperties)) << bad;
  }
}

// A literal must be parsed as exactly the same value.
TEST(Recipe, WritesLiteralsThatTheConstraintLanguageReads) {
  const std::vector<Value> values = {Value::Double(1e300),
                                     Value::Double(-1e-300),
                                     Value::Double(0.1),
                                     Value::Double(3),
                                     Value::Double(-0.0),
                                     Value::Double(std::numeric_limits<double>::denorm_min()),
                                     Value::Float(0.1f),
                                     Value::ULong(4'000'000'000u),
                                     Value::Long(std::numeric_limits<std::int32_t>::min()),
                                     Value::String("'\\'"),
                                     Value::Char('\\'),
                                     Value::Boolean(true)};
  for (const Value& value : values) {
    const PropertyList properties({{"x", value}});
    const auto text = FollowRecipe("x == $(x)", properties, "");
    ASSERT_TRUE(text);
    const auto constraint = ParseConstraint(*text, {});
    ASSERT_TRUE(constraint) << *text;
    EXPECT_TRUE(Matches(*constraint, properties)) << *text;
  }
}

}  // namespace
}  // namespace gsv::broker
