#include <limits>
#include <map>
#include <string>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "gsv/base/test_within.h"

namespace gsv::base {
namespace {

std::map<std::string, std::string> Kept() {
  const ::testing::TestResult& result =
      *::testing::UnitTest::GetInstance()->current_test_info()->result();
  std::map<std::string, std::string> kept;
  for (int i = 0; i < result.test_property_count(); ++i) {
    kept[result.GetTestProperty(i).key()] = result.GetTestProperty(i).value();
  }
  return kept;
}

using Properties = std::map<std::string, std::string>;

TEST(Within, RecordsTheLargestErrorForEachBoundAndUnit) {
  EXPECT_WITHIN(2.25, 2, 0.5, "m");
  EXPECT_WITHIN(1.625, 2, 0.5, "m");
  EXPECT_WITHIN(2.125, 2, 0.5, "m");
  EXPECT_WITHIN(2, 2, 0.5, "rad");
  EXPECT_WITHIN(1, 2, 1, "m");
  EXPECT_WITHIN_PERCENT(-99, -100, 2);
  EXPECT_WITHIN_3_SIGMA(5, 4, 0.5);
  EXPECT_EQ(Kept(), (Properties{{"within 0.5 m", "0.375"},
                                {"within 0.5 rad", "0"},
                                {"within 1 m", "1"},
                                {"within 2 %", "1"},
                                {"within 3 σ", "2"}}));
}

TEST(Within, FailsBeyondTheBoundOnEitherSide) {
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN(2.501, 2, 0.5, "m"), "at most 0.5 m are allowed");
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN(1.499, 2, 0.5, "m") << "to the left", "to the left");
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN_PERCENT(97, 100, 2), "97, 3 % from 100");
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN_3_SIGMA(4, 2, 0.5), "at most 3 σ");
}

TEST(Within, FailsForNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN(std::numeric_limits<double>::quiet_NaN(), 0, 1, "m"),
                          "nan");
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN(0, std::numeric_limits<double>::quiet_NaN(), 1, "m"),
                          "nan");
  EXPECT_NONFATAL_FAILURE(EXPECT_WITHIN_PERCENT(0, 0, 1), "nan");
  EXPECT_FALSE(testing::Within("", "", "", "", nan, nan, nan, "m"));
}

class WithinOfAParameter : public ::testing::TestWithParam<int> {};

TEST_P(WithinOfAParameter, RecordsItsErrorForEachParameterizedTest) {
  EXPECT_WITHIN(GetParam(), 0, 10, "m");
  EXPECT_EQ(Kept(), (Properties{{"within 10 m", std::to_string(GetParam())}}));
}

INSTANTIATE_TEST_SUITE_P(Two, WithinOfAParameter, ::testing::Values(3, 2));

}  // namespace
}  // namespace gsv::base
