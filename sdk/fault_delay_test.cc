#include "sdk/fault_delay.h"

#include <set>

#include <gtest/gtest.h>

namespace gsv::sdk {
namespace {

using namespace std::chrono_literals;

TEST(FaultDelay, ReadsSeedAndLimit) {
  const auto fault = ParseFaultDelay("seed=7,max_ms=20");
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->seed, 7u);
  EXPECT_EQ(fault->max, 20ms);
}

TEST(FaultDelay, RejectsInvalidSettings) {
  for (const char* text :
       {"", "seed=7", "max_ms=20", "seed=7,max_ms=", "seed=,max_ms=1", "seed=7,max_ms=20ms",
        "seed=7;max_ms=20", "seed=7,max_ms=60001", "seed=-1,max_ms=2", "seed=7,max_ms=1.5", "on"}) {
    const auto fault = ParseFaultDelay(text);
    ASSERT_FALSE(fault) << text;
    EXPECT_EQ(fault.error().code, base::ErrorCode::kInvalidArgument);
    EXPECT_NE(fault.error().Sentence().find("max_ms=MILLISECONDS"), std::string::npos);
  }
}

TEST(FaultDelay, DelaysRepeatWithTheSeedAndStayBelowTheLimit) {
  const FaultDelay seven{7, 20ms}, eight{8, 20ms};
  std::set<std::chrono::nanoseconds> different;
  std::chrono::nanoseconds sum{0};
  int unequal = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const auto delay = NthDelay(seven, n);
    EXPECT_EQ(delay, NthDelay(seven, n));
    EXPECT_GE(delay, 0ns);
    EXPECT_LT(delay, 20ms);
    different.insert(delay);
    sum += delay;
    if (delay != NthDelay(eight, n)) ++unequal;
  }
  EXPECT_GT(different.size(), 990u);
  EXPECT_GT(unequal, 990);
  // The delays are uniform over 20 ms. So the mean is 10 ms, and its standard deviation is 20 ms /
  // sqrt(12 * 1000).
  EXPECT_NEAR(static_cast<double>((sum / 1000).count()), 10e6, 5 * 20e6 / 109.5);
}

TEST(FaultDelay, WithoutALimitCallsAreNotDelayed) { EXPECT_EQ(NthDelay({7, 0ms}, 3), 0ns); }

}  // namespace
}  // namespace gsv::sdk
