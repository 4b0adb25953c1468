#include "gsv/gateway/live/step_cost_topic.h"

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::StepCosts;
using std::chrono::milliseconds;
using testing::Decoded;
using testing::LiveStreamTest;

simulation::StepTimes StepOf(std::int64_t step, milliseconds behaviours, const std::string& robot) {
  simulation::StepTimes times;
  times.step = step;
  times.time = milliseconds(10 * step);
  times.behaviours = behaviours;
  times.bodies = milliseconds(1);
  times.idle = milliseconds(2);
  times.held_up_by = robot;
  return times;
}

TEST_F(LiveStreamTest, StepTimesAddUpAndNameTheBehaviourThatDelaysSteps) {
  EXPECT_EQ(simulation_->observers(), 0u);
  Subscribe(1, "/gsv/step_costs");
  Round(milliseconds(600));
  EXPECT_EQ(client_->data(1).size(), 0u) << "no step yet";
  simulation_->Time(StepOf(1, milliseconds(3), "a"));
  simulation_->Time(StepOf(2, milliseconds(50), "b"));
  simulation_->Time(StepOf(3, milliseconds(4), "a"));
  simulation_->Time(StepOf(4, milliseconds(0), ""));
  Round(milliseconds(600));
  ASSERT_EQ(client_->data(1).size(), 1u);
  const auto costs = Decoded<StepCosts>(client_->data(1)[0]);
  EXPECT_EQ(costs.steps, 4u);
  EXPECT_EQ(costs.stamp.nanosec, 40'000'000u);
  EXPECT_EQ(costs.sum.step, 4u);
  EXPECT_DOUBLE_EQ(costs.sum.behaviours_s, 0.057);
  EXPECT_DOUBLE_EQ(costs.sum.bodies_s, 0.004);
  EXPECT_DOUBLE_EQ(costs.sum.idle_s, 0.008);
  ASSERT_EQ(costs.hold_ups.size(), 2u);
  EXPECT_EQ(costs.hold_ups[0].robot, "b");
  EXPECT_EQ(costs.hold_ups[1].robot, "a");
  EXPECT_EQ(costs.hold_ups[1].steps, 2u);
  EXPECT_DOUBLE_EQ(costs.hold_ups[1].total_s, 0.007);
  EXPECT_DOUBLE_EQ(costs.hold_ups[1].longest_s, 0.004);
  ASSERT_EQ(costs.longest.size(), 4u);
  EXPECT_EQ(costs.longest[1].held_up_by, "b");
  Round(milliseconds(600));
  EXPECT_EQ(client_->data(1).size(), 1u) << "no further step";
}

TEST_F(LiveStreamTest, TheLongestStepsAreListedInTheirOrder) {
  Subscribe(1, "/gsv/step_costs");
  Round();
  for (int step = 1; step <= 100; ++step) {
    simulation_->Time(StepOf(step, milliseconds(step % 2 == 0 ? 1 : 100 + step), "a"));
  }
  Round(milliseconds(600));
  ASSERT_EQ(client_->data(1).size(), 1u);
  const auto longest = Decoded<StepCosts>(client_->data(1)[0]).longest;
  ASSERT_EQ(longest.size(), kMaxLongestSteps);
  for (std::size_t i = 0; i < longest.size(); ++i) EXPECT_EQ(longest[i].step, 37 + 2 * i);
}

TEST_F(LiveStreamTest, StepsAreTimedOnlyForSubscribers) {
  Subscribe(1, "/gsv/step_costs");
  Round();
  EXPECT_EQ(simulation_->observers(), 1u);
  stream_.hub()->Remove(client_.get());
  Round();
  EXPECT_EQ(simulation_->observers(), 0u);
}

}  // namespace
}  // namespace gsv::gateway
