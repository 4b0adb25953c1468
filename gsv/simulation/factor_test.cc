// Tests changes of the real-time factor during a run.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

// A run with ten steps of 10 ms. At this real-time factor, each step takes ten seconds.
Specification Slow() {
  Specification specification = Lockstep(100ms);
  specification.mode = Mode::kRealTime;
  specification.factor = 0.001;
  return specification;
}

TEST(RealTimeFactor, SlowRunCanBeAccelerated) {
  const auto simulation = Make(Slow());
  ASSERT_TRUE(simulation->Start());
  ASSERT_TRUE(simulation->SetRealTimeFactor(1000));
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  EXPECT_EQ(simulation->real_time_factor(), 1000);
  EXPECT_EQ(simulation->status().target_factor, 1000);
  EXPECT_EQ(simulation->specification().factor, 0.001);
  const std::vector<Event> events = simulation->events(0);
  ASSERT_EQ(events.size(), 3u);  // the start, the change of the factor, and the end
  EXPECT_EQ(events[1].kind, "factor_set");
  EXPECT_EQ(events[1].detail, "1000");
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(simulation->real_time_factor(), 1000);
}

TEST(RealTimeFactor, IsThatOfTheWorldIfNoneIsGiven) {
  Specification specification = Slow();
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  world->real_time_factor = 2.5;
  specification.world = world;
  specification.factor = 0;
  EXPECT_EQ(Make(specification)->status().target_factor, 2.5);
  specification.factor = 3;
  EXPECT_EQ(Make(specification)->status().target_factor, 3);
}

TEST(RealTimeFactor, RejectsInvalidFactors) {
  const auto simulation = Make(Slow());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, 2e6, std::nan(""), kInfinity}) {
    const base::Status set = simulation->SetRealTimeFactor(bad);
    ASSERT_FALSE(set) << bad;
    EXPECT_EQ(set.error().code, base::ErrorCode::kInvalidArgument);
  }
  EXPECT_EQ(simulation->real_time_factor(), 0.001);
  const base::Status lockstep = Make(Lockstep(100ms))->SetRealTimeFactor(2);
  ASSERT_FALSE(lockstep);
  EXPECT_NE(lockstep.error().message.find("no real-time factor"), std::string::npos);
}

}  // namespace
}  // namespace gsv::simulation
