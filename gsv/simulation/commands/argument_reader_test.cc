#include "gsv/simulation/commands/argument_reader.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

const Command& Lift() {
  static const Command kLift{
      "lift",
      "Lift something",
      {{.name = "height", .unit = "m", .minimum = -2, .maximum = 2},
       {.name = "count",
        .type = ParameterType::kInteger,
        .minimum = 1,
        .default_value = std::int64_t{3}},
       {.name = "gently", .type = ParameterType::kFlag, .default_value = false},
       {.name = "of", .type = ParameterType::kText, .default_meaning = "all bodies"}},
      nullptr};
  return kLift;
}

using Texts = std::map<std::string, std::string>;

TEST(ArgumentReader, ReadsEachTypeAndAddsDefaultValues) {
  const auto read = ReadArguments(Lift(), Texts{{"height", "-1.5"}, {"of", "7"}});
  ASSERT_TRUE(read) << read.error().Sentence();
  EXPECT_EQ(read->Get<double>("height"), -1.5);
  EXPECT_EQ(read->Get<std::int64_t>("count"), 3);
  EXPECT_EQ(read->Get<bool>("gently"), false);
  EXPECT_EQ(read->Get<std::string>("of"), "7");
  EXPECT_EQ(ReadArguments(Lift(), Texts{{"height", "1"}})->Find<std::string>("of"), nullptr);
}

TEST(ArgumentReader, AcceptsIntegersAndNumbersWithoutAFraction) {
  const auto read =
      ReadArguments(Lift(), Arguments::Values{{"height", std::int64_t{2}}, {"count", 7.0}});
  ASSERT_TRUE(read) << read.error().Sentence();
  EXPECT_EQ(read->Get<double>("height"), 2.0);
  EXPECT_EQ(read->Get<std::int64_t>("count"), 7);
}

TEST(ArgumentReader, NamesCommandAndParameterOfARefusedValue) {
  const struct {
    Arguments::Values given;
    const char* sentence;
  } kCases[]{
      {{}, "lift: 'height' must be a number from -2 to 2 m, and it is missing"},
      {{{"height", 2.5}}, "lift: 'height' must be a number from -2 to 2 m, and it is 2.5"},
      {{{"height", std::nan("")}}, "lift: 'height' must be a number from -2 to 2 m, and it is nan"},
      {{{"height", true}}, "lift: 'height' must be a number from -2 to 2 m, and it is true"},
      {{{"height", 0.0}, {"count", std::int64_t{0}}},
       "lift: 'count' must be a whole number from 1, and it is 0"},
      {{{"height", 0.0}, {"count", 1.5}},
       "lift: 'count' must be a whole number from 1, and it is 1.5"},
      {{{"height", 0.0}, {"count", std::numeric_limits<double>::infinity()}},
       "lift: 'count' must be a whole number from 1, and it is inf"},
      {{{"height", 0.0}, {"gently", std::string("yes")}},
       "lift: 'gently' must be true or false, and it is \"yes\""},
      {{{"height", 0.0}, {"of", 1.0}}, "lift: 'of' must be a text, and it is 1"},
      {{{"height", 0.0}, {"hight", 1.0}},
       "lift: there is no parameter 'hight'; known: height, count, gently, of"},
  };
  for (const auto& [given, sentence] : kCases) {
    const auto read = ReadArguments(Lift(), given);
    ASSERT_FALSE(read) << sentence;
    EXPECT_EQ(read.error().code, base::ErrorCode::kInvalidArgument);
    EXPECT_EQ(read.error().Sentence(), sentence);
  }
}

TEST(ArgumentReader, RejectsTextsOfTheWrongType) {
  for (const char* text : {"", "down", "1m", "nan", "inf", "1e400", "0x1"}) {
    EXPECT_FALSE(ReadArguments(Lift(), Texts{{"height", text}})) << text;
  }
  EXPECT_EQ(
      ReadArguments(Command{"halt", "", {}, nullptr}, Texts{{"at", "once"}}).error().Sentence(),
      "halt: there is no parameter 'at'; the command takes no parameters");
}

}  // namespace
}  // namespace gsv::simulation
