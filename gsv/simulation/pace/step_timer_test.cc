#include "gsv/simulation/pace/step_timer.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using std::chrono::milliseconds;

WallTime At(int ms) { return WallTime() + milliseconds(ms); }

TEST(StepTimer, DividesTheTimeSinceTheLastStep) {
  StepTimer timer;
  timer.Begin(At(100), "ignored");
  timer.Mark(&StepTimes::bodies, At(110));
  EXPECT_EQ(timer.End(1, SimTime(5)).total(), milliseconds(10));
  timer.AddIdle(milliseconds(30));
  timer.Begin(At(160), "a");
  timer.Mark(&StepTimes::devices, At(161));
  timer.Mark(&StepTimes::bodies, At(165));
  timer.Mark(&StepTimes::observers, At(167));
  const StepTimes times = timer.End(2, SimTime(10));
  EXPECT_EQ(times.step, 2);
  EXPECT_EQ(times.held_up_by, "a");
  EXPECT_EQ(times.idle, milliseconds(30));
  EXPECT_EQ(times.behaviours, milliseconds(20));
  EXPECT_EQ(times.devices, milliseconds(1));
  EXPECT_EQ(times.bodies, milliseconds(4));
  EXPECT_EQ(times.observers, milliseconds(2));
  EXPECT_EQ(times.total(), At(167) - At(110));
}

TEST(StepTimer, APauseDoesNotCount) {
  StepTimer timer;
  timer.Begin(At(1), "");
  timer.Mark(&StepTimes::bodies, At(2));
  timer.End(1, SimTime(5));
  timer.Interrupt();
  timer.Begin(At(60'000), "a");
  timer.Mark(&StepTimes::bodies, At(60'003));
  const StepTimes times = timer.End(2, SimTime(10));
  EXPECT_EQ(times.total(), milliseconds(3));
  EXPECT_EQ(times.held_up_by, "");
}

}  // namespace
}  // namespace gsv::simulation
