#include "gsv/presentation/health_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::presentation {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

health::RobotHealth Stuck() {
  health::RobotHealth robot;
  robot.robot = "pebble";
  robot.state = health::State::kStuck;
  robot.level = health::Level::kWarning;
  robot.since = 15700ms;
  robot.command.linear = 0.3;
  robot.limit = health::Limit{"sonar_00", 0.26};
  robot.contact = "wall";
  robot.summary = "has been stuck";
  robot.reason = "commanded 0.3 m/s";
  return robot;
}

health::Report ReportOf(std::vector<health::RobotHealth> robots) {
  health::Report report;
  report.time = 20s;
  report.step = 2000;
  report.stuck_after = 5s;
  for (const auto& robot : robots) ++report.counts[static_cast<std::size_t>(robot.state)];
  report.robots = std::move(robots);
  return report;
}

TEST(HealthMessage, ListsOnlyRobotsThatDoNotMove) {
  health::RobotHealth moving;
  moving.robot = "another";
  const auto message = HealthMessage(ReportOf({moving, Stuck()}));
  EXPECT_EQ(message.stamp.sec, 20);
  EXPECT_EQ(message.stuck_after_s, 5);
  EXPECT_EQ(message.moving, 1u);
  EXPECT_EQ(message.stuck, 1u);
  ASSERT_EQ(message.robots.size(), 1u);
  EXPECT_EQ(message.robots[0].robot, "pebble");
  EXPECT_EQ(message.robots[0].state, "stuck");
  EXPECT_EQ(message.robots[0].level, 1);
  EXPECT_EQ(message.robots[0].since.sec, 15);
  EXPECT_EQ(message.robots[0].since.nanosec, 700'000'000u);
  EXPECT_EQ(message.robots[0].command_linear_m_s, 0.3);
  EXPECT_EQ(message.robots[0].limit_sensor, "sonar_00");
  EXPECT_EQ(message.robots[0].limit_value, 0.26);
  EXPECT_EQ(message.robots[0].contact, "wall");
}

TEST(HealthMessage, IsNotSentAgainIfOnlyTimeAndMotionChange) {
  const auto sent = HealthMessage(ReportOf({Stuck()}));
  health::RobotHealth later = Stuck();
  later.linear = 0.01;
  auto report = ReportOf({later});
  report.time = 21s;
  EXPECT_FALSE(NeedsSending(HealthMessage(report), sent));
  later.contact = "shelf";
  EXPECT_TRUE(NeedsSending(HealthMessage(ReportOf({later})), sent));
  EXPECT_TRUE(NeedsSending(HealthMessage(ReportOf({})), sent));
}

TEST(ExpectationsMessage, HasVerdictMarginAndShapes) {
  simulation::ExpectationState state;
  state.name = "keeps its distance";
  state.verdict = simulation::ExpectationState::Verdict::kViolated;
  state.margin = -0.1;
  state.unit = "m";
  state.time = 3210ms;
  state.bodies = {"a", "b"};
  state.places = {{1, 2, 0.25}};
  state.boxes = {{0, 1, 2, 3}};
  const auto message = ExpectationsMessage(4s, {state});
  EXPECT_EQ(message.stamp.sec, 4);
  ASSERT_EQ(message.expectations.size(), 1u);
  EXPECT_EQ(message.expectations[0].state, "violated");
  EXPECT_TRUE(message.expectations[0].has_margin);
  EXPECT_EQ(message.expectations[0].margin, -0.1);
  EXPECT_DOUBLE_EQ(message.expectations[0].time_s, 3.21);
  EXPECT_THAT(message.expectations[0].bodies, ElementsAre("a", "b"));
  EXPECT_THAT(message.expectations[0].places, ElementsAre(1, 2, 0.25));
  EXPECT_THAT(message.expectations[0].boxes, ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace gsv::presentation
