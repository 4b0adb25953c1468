#include "gsv/gateway/live/pacing.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

int CountIn(std::chrono::seconds length, microseconds round, WallTime start) {
  Pacing pacing(10);
  int count = 0;
  for (WallTime now = start; now < start + length; now += round) {
    if (!pacing.IsDue(now)) continue;
    pacing.Done(now);
    ++count;
  }
  return count;
}

TEST(Pacing, KeepsTheMeanRateForAnyPollingRate) {
  const WallTime start = WallTime{} + std::chrono::hours(5);
  for (const microseconds round :
       {microseconds(1000), microseconds(33'333), microseconds(99'999)}) {
    EXPECT_NEAR(CountIn(std::chrono::seconds(10), round, start), 100, 1) << round.count();
  }
  // If the calls are less frequent than the rate, every call may send.
  EXPECT_EQ(CountIn(std::chrono::seconds(10), milliseconds(250), start), 40);
}

TEST(Pacing, SendsNoBurstAfterAPause) {
  Pacing pacing(10);
  const WallTime start = WallTime{} + std::chrono::hours(5);
  pacing.Done(start);
  pacing.Done(start + std::chrono::seconds(60));
  EXPECT_FALSE(pacing.IsDue(start + std::chrono::seconds(60) + milliseconds(70)));
  EXPECT_TRUE(pacing.IsDue(start + std::chrono::seconds(60) + milliseconds(80)));
}

}  // namespace
}  // namespace gsv::gateway
