#include "gsv/simulation/pace/pacer.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using std::chrono::milliseconds;

TEST(Pacer, StepsAreDueAtMultiplesOfTheScaledStep) {
  Pacer pacer(milliseconds(10), 2.0);
  const WallTime start = WallNow();
  pacer.Restart(start);
  EXPECT_EQ(pacer.due(), start);
  EXPECT_FALSE(pacer.StepStarts(start));
  EXPECT_EQ(pacer.due(), start + milliseconds(5));
}

TEST(Pacer, DelayOfUpToOneStepKeepsTheSchedule) {
  Pacer pacer(milliseconds(10), 1.0);
  const WallTime start = WallNow();
  pacer.Restart(start);
  EXPECT_FALSE(pacer.StepStarts(start + milliseconds(10)));
  EXPECT_EQ(pacer.due(), start + milliseconds(10));
  EXPECT_EQ(pacer.late_steps(), 0u);
}

TEST(Pacer, LongerDelayIsCountedAndShiftsTheSchedule) {
  Pacer pacer(milliseconds(10), 1.0);
  const WallTime start = WallNow();
  pacer.Restart(start);
  EXPECT_TRUE(pacer.StepStarts(start + milliseconds(73)));
  EXPECT_EQ(pacer.due(), start + milliseconds(83));
  EXPECT_FALSE(pacer.StepStarts(start + milliseconds(83)));
  EXPECT_EQ(pacer.late_steps(), 1u);
}

TEST(Pacer, NewFactorAppliesFromTheNextStep) {
  Pacer pacer(milliseconds(10), 0.001);  // a step is due every ten seconds
  const WallTime start = WallNow();
  pacer.Restart(start);
  EXPECT_FALSE(pacer.StepStarts(start));
  EXPECT_EQ(pacer.due(), start + milliseconds(10'000));
  pacer.SetRealTimeFactor(2);
  EXPECT_EQ(pacer.due(), start + milliseconds(5));
  EXPECT_FALSE(pacer.StepStarts(start + milliseconds(5)));
  EXPECT_EQ(pacer.due(), start + milliseconds(10));
  EXPECT_EQ(pacer.late_steps(), 0u);
}

}  // namespace
}  // namespace gsv::simulation
