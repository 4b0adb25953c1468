// Assertions that a measured value is close to the expected one, which also record the error.
//
//   EXPECT_WITHIN(robot.x, 2.0, 1e-9, "m") << "at " << speed;  // |measured - expected| <= 1e-9
//   EXPECT_WITHIN_PERCENT(period, expected, 0.1);              // error <= 0.1 % of `expected`
//   EXPECT_WITHIN_3_SIGMA(mean, 0.0, 1 / std::sqrt(count));    // error <= 3 * sigma
//
// The largest error for each bound and unit becomes a property of the running test (GoogleTest's
// RecordProperty). The property's name is "within BOUND UNIT", for example "within 1e-09 m", and
// its value is the error, for example "3.2e-14". tools/make_fidelity_tables reads these properties
// from GoogleTest's reports. A NaN fails the assertion.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace gsv::base::testing {

inline std::string FormatNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// Records the error as a property of the running test, unless a larger error with the same bound
// and unit is already recorded.
inline void RecordLargestError(double error, double bound, const std::string& unit) {
  const std::string key = "within " + FormatNumber(bound) + " " + unit;
  const ::testing::TestInfo* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  for (int i = 0; i < test->result()->test_property_count(); ++i) {
    const ::testing::TestProperty& kept = test->result()->GetTestProperty(i);
    if (kept.key() == key && !(error > std::strtod(kept.value(), nullptr))) return;
  }
  ::testing::Test::RecordProperty(key, FormatNumber(error));
}

// Records `error` and compares it with `bound`, both in `unit`. The other arguments are the texts
// of the expressions in the source.
inline ::testing::AssertionResult CheckError(double error, double bound, const std::string& unit,
                                             const char* measured_text, double measured,
                                             const char* expected_text, double expected) {
  RecordLargestError(error, bound, unit);
  if (error <= bound) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << measured_text << " is " << ::testing::PrintToString(measured) << ", "
         << FormatNumber(error) << " " << unit << " from " << expected_text << ", which is "
         << ::testing::PrintToString(expected) << "; at most " << FormatNumber(bound) << " " << unit
         << " are allowed";
}

// The predicates of the macros EXPECT_WITHIN and ASSERT_WITHIN, EXPECT_WITHIN_PERCENT, and
// EXPECT_WITHIN_3_SIGMA. GoogleTest passes each argument as text and as value.
inline ::testing::AssertionResult Within(const char* measured_text, const char* expected_text,
                                         const char*, const char*, double measured, double expected,
                                         double bound, const std::string& unit) {
  return CheckError(std::abs(measured - expected), bound, unit, measured_text, measured,
                    expected_text, expected);
}

inline ::testing::AssertionResult WithinPercent(const char* measured_text,
                                                const char* expected_text, const char*,
                                                double measured, double expected, double percent) {
  return CheckError(100 * std::abs((measured - expected) / expected), percent, "%", measured_text,
                    measured, expected_text, expected);
}

inline ::testing::AssertionResult Within3Sigma(const char* measured_text, const char* expected_text,
                                               const char*, double measured, double expected,
                                               double sigma) {
  return CheckError(std::abs(measured - expected) / sigma, 3, "σ", measured_text, measured,
                    expected_text, expected);
}

}  // namespace gsv::base::testing

#define EXPECT_WITHIN(measured, expected, bound, unit) \
  EXPECT_PRED_FORMAT4(::gsv::base::testing::Within, measured, expected, bound, unit)
#define ASSERT_WITHIN(measured, expected, bound, unit) \
  ASSERT_PRED_FORMAT4(::gsv::base::testing::Within, measured, expected, bound, unit)
#define EXPECT_WITHIN_PERCENT(measured, expected, percent) \
  EXPECT_PRED_FORMAT3(::gsv::base::testing::WithinPercent, measured, expected, percent)
#define EXPECT_WITHIN_3_SIGMA(measured, expected, sigma) \
  EXPECT_PRED_FORMAT3(::gsv::base::testing::Within3Sigma, measured, expected, sigma)
