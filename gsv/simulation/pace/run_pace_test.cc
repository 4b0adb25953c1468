#include "gsv/simulation/pace/run_pace.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

TEST(RunPace, TheFirstStepAfterAResumeIsDueAtOnce) {
  RunPace pace(1h, 1);
  pace.SetRunning(true, 0s);
  pace.RestartIfResumed();
  const WallTime start = pace.due();
  EXPECT_LE(start, WallNow());
  pace.StepStarts(start);
  EXPECT_EQ(pace.due(), start + 1h);
  pace.RestartIfResumed();  // the run was not paused, so nothing changes
  EXPECT_EQ(pace.due(), start + 1h);
  pace.SetRunning(false, 1h);
  pace.SetRunning(true, 1h);
  pace.RestartIfResumed();
  EXPECT_LE(pace.due(), WallNow());
}

TEST(RunPace, AResetForgetsTheStatisticsAndKeepsTheFactor) {
  RunPace pace(10ms, 2);
  pace.SetRealTimeFactor(4);
  pace.SetRunning(true, 0s);
  pace.RestartIfResumed();
  pace.StepStarts(pace.due() + 1h);  // the step is late
  pace.StepEnds(pace.due(), pace.due() + 1ms, 10ms);
  pace.SetRunning(false, 10ms);
  SimulationStatus status;
  pace.FillStatus(status);
  EXPECT_EQ(status.late_steps, 1u);
  EXPECT_EQ(status.mean_step_time, 1ms);
  pace.Reset();
  pace.FillStatus(status);
  EXPECT_EQ(status.late_steps, 0u);
  EXPECT_EQ(status.mean_step_time, 0ms);
  EXPECT_EQ(status.target_factor, 4);
}

}  // namespace
}  // namespace gsv::simulation
