#include "gsv/gateway/live/health_topics.h"

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"
#include "gsv/messages/rcl_interfaces.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::Expectations;
using messages::gsv_msgs::Health;
using messages::rcl_interfaces::Log;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::LiveStreamTest;

TEST_F(LiveStreamTest, HealthIsSentAtEachChangeTwicePerSecondAtMost) {
  simulation::Motion motion;
  motion.is_moving = true;
  simulation_->SetMotion("robot_0", motion);
  Subscribe(1, "/gsv/health");
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  EXPECT_EQ(Decoded<Health>(client_->data(1)[0]).moving, 1u);
  Round(seconds(1));
  EXPECT_EQ(client_->data(1).size(), 1u) << "nothing has changed";
  motion.is_moving = false;
  motion.is_stuck = true;
  motion.since = seconds(3);
  simulation_->SetMotion("robot_0", motion);
  for (int i = 0; i < 10; ++i) Round(milliseconds(34));
  Round(seconds(1));
  ASSERT_EQ(client_->data(1).size(), 2u);
  const auto health = Decoded<Health>(client_->data(1)[1]);
  EXPECT_EQ(health.stuck, 1u);
  bool has_robot = false;
  for (const auto& robot : health.robots) {
    if (robot.robot != "robot_0") continue;
    has_robot = true;
    EXPECT_EQ(robot.state, "stuck");
    EXPECT_EQ(robot.since.sec, 3);
  }
  EXPECT_TRUE(has_robot);
}

TEST_F(LiveStreamTest, OutputOfBehavioursHasItsOwnTopic) {
  simulation_->Emit("stderr", "robot_0", "ValueError: too far");
  Subscribe(1, "/gsv/output");
  Subscribe(2, "/gsv/events");
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  const auto line = Decoded<Log>(client_->data(1)[0]);
  EXPECT_EQ(line.name, "robot_0");
  EXPECT_EQ(line.msg, "ValueError: too far");
  EXPECT_EQ(line.file, "stderr");
  EXPECT_EQ(line.level, Log::kWarn);
  simulation_->Emit("program_ended", "robot_0", "gsv-wander ended with exit code 1");
  Round();
  ASSERT_EQ(client_->data(1).size(), 2u);
  EXPECT_EQ(Decoded<Log>(client_->data(1)[1]).level, Log::kError);
  EXPECT_EQ(client_->data(2).size(), 0u);
}

class OneExpectation final : public simulation::ExpectationSource {
 public:
  std::vector<simulation::ExpectationState> states() const override { return {state}; }
  simulation::ExpectationState state;
};

TEST_F(LiveStreamTest, ExpectationsAreSentAtEachChange) {
  const auto source = std::make_shared<OneExpectation>();
  source->state.name = "arrives";
  simulation_->SetExpectations(source);
  Subscribe(1, "/gsv/expectations");
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  EXPECT_EQ(Decoded<Expectations>(client_->data(1)[0]).expectations.at(0).state, "pending");
  Round(seconds(1));
  EXPECT_EQ(client_->data(1).size(), 1u);
  source->state.verdict = simulation::ExpectationState::Verdict::kViolated;
  Round(seconds(1));
  ASSERT_EQ(client_->data(1).size(), 2u);
  EXPECT_EQ(Decoded<Expectations>(client_->data(1)[1]).expectations.at(0).state, "violated");
}

}  // namespace
}  // namespace gsv::gateway
