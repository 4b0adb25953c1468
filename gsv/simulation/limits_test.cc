#include "gsv/simulation/limits.h"

#include <gtest/gtest.h>

#include "gsv/simulation/pace/totals.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

class LimitsTest : public ::testing::Test {
 public:
  ~LimitsTest() override { ProcessLimits() = {}; }
};

TEST_F(LimitsTest, RobotsAreLimited) {
  ProcessLimits().robots = 3;
  const auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("a", 0, -2)));
  // Two robots are added together, but the limit allows only one more. So neither is added.
  std::vector<RobotSpecification> crowd;
  for (const char* name : {"b", "c", "d"}) {
    crowd.push_back(Robot(name, 0, static_cast<double>(crowd.size())));
  }
  const auto refused = simulation->AddRobots(crowd);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
  EXPECT_NE(refused.error().message.find("at most 3 robots"), std::string::npos);
  EXPECT_EQ(simulation->status().robots.size(), 1u);
  crowd.pop_back();
  EXPECT_TRUE(simulation->AddRobots(crowd));
  EXPECT_FALSE(simulation->AddRobot(Robot("d", 0, 2)));
  ASSERT_TRUE(simulation->RemoveRobot("a"));
  EXPECT_TRUE(simulation->AddRobot(Robot("d", 0, 2)));
}

TEST_F(LimitsTest, SensorsAreLimited) {
  ProcessLimits().sensors_of_a_robot = 2;  // the model already has one sensor
  const auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0)));
  model::SensorDescription sonar = Disc(0.2)->sensors.front();
  sonar.name = "second";
  EXPECT_TRUE(simulation->agent("robot")->CreateSensor(sonar));
  sonar.name = "third";
  const auto refused = simulation->agent("robot")->CreateSensor(sonar);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("at most 2 sensors"), std::string::npos);
}

TEST_F(LimitsTest, ClocksAreLimited) {
  auto simulation = Make(Lockstep(100ms));
  std::vector<bool> opened;
  std::string refusal;
  ASSERT_TRUE(simulation->AddRobot(
      Robot("robot", 0, 0, std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId) {
              std::vector<ClockId> more;  // the behaviour already has one clock
              for (int i = 2; i <= 64; ++i) {
                const auto clock = agent.OpenClock();
                opened.push_back(clock.has_value());
                if (clock) more.push_back(*clock);
              }
              if (const auto beyond = agent.OpenClock(); !beyond) refusal = beyond.error().message;
              opened.push_back(agent.CloseClock(more.back()).has_value());
              more.pop_back();
              const auto again = agent.OpenClock();
              opened.push_back(again.has_value());
              if (again) more.push_back(*again);
              for (const ClockId clock : more) (void)agent.CloseClock(clock);
            }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(opened, std::vector<bool>(65, true));
  EXPECT_EQ(refusal, "an agent has at most 64 clocks open; close one first");
}

TEST_F(LimitsTest, KeepsTenThousandEvents) {
  Specification specification = Lockstep(0s);
  specification.mode = Mode::kRealTime;
  const auto simulation = Make(specification);
  ASSERT_TRUE(simulation->events(0).empty());
  for (int i = 0; i < 10'000; ++i) ASSERT_TRUE(simulation->SetRealTimeFactor(2 + i % 2));
  const auto all = simulation->events(0);
  ASSERT_EQ(all.size(), 10'000u);
  ASSERT_TRUE(simulation->SetRealTimeFactor(4));
  const auto newest = simulation->events(0);
  ASSERT_EQ(newest.size(), 10'000u);
  // The first event was dropped, so the second event is now the first in the list. Its number is
  // unchanged.
  EXPECT_EQ(newest.front().detail, all[1].detail);
  EXPECT_EQ(newest.back().kind, "factor_set");
  EXPECT_NE(newest.back().detail, all.back().detail);
  EXPECT_EQ(simulation->events(10'000).size(), 1u);
}

TEST(Totals, CountStepsOfAllSimulations) {
  const std::uint64_t before = ProcessTotals().steps;
  for (int i = 0; i < 2; ++i) {
    const auto simulation = Make(Lockstep(100ms));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  }
  EXPECT_EQ(ProcessTotals().steps - before, 2u * 10u);
}

}  // namespace
}  // namespace gsv::simulation
