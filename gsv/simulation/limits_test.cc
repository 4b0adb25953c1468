#include "gsv/simulation/limits.h"

#include <gtest/gtest.h>

#include "gsv/simulation/test_simulation.h"
#include "gsv/simulation/totals.h"

namespace gsv::simulation {
namespace {

class LimitsTest : public ::testing::Test {
 protected:
  ~LimitsTest() override { ProcessLimits() = {}; }
};

TEST_F(LimitsTest, RobotsAreTakenUpToTheirNumberAndNotBeyond) {
  ProcessLimits().robots = 3;
  const auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("a", 0, -2)));
  // Two at once, of which only one fits: neither comes.
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

TEST_F(LimitsTest, SensorsAreTakenUpToTheirNumberAndNotBeyond) {
  ProcessLimits().sensors_of_a_robot = 2;  // the model has one
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
