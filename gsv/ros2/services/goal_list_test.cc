#include "gsv/ros2/services/goal_list.h"

#include <gtest/gtest.h>

namespace gsv::ros2 {
namespace {

using messages::action_msgs::CancelGoalRequest;
using messages::action_msgs::CancelGoalResponse;
using messages::action_msgs::GoalStatus;

GoalList::Id IdOf(std::uint8_t number) {
  GoalList::Id id{};
  id[15] = number;
  return id;
}

// Returns the goals 1 and 2, which were accepted at 1 s and 2 s. Goal 1 is executing.
GoalList TwoGoals() {
  GoalList goals;
  EXPECT_TRUE(goals.Accept(IdOf(1), {1, 0}));
  EXPECT_TRUE(goals.Accept(IdOf(2), {2, 0}));
  EXPECT_TRUE(goals.Begin(IdOf(1)));
  return goals;
}

std::vector<GoalList::Status> StatesAfter(const CancelGoalRequest& request) {
  GoalList goals = TwoGoals();
  (void)goals.Cancel(request);
  return {goals.StatusOf(IdOf(1)), goals.StatusOf(IdOf(2))};
}

constexpr auto kExecuting = GoalStatus::kStatusExecuting, kAccepted = GoalStatus::kStatusAccepted,
               kCanceling = GoalStatus::kStatusCanceling;

TEST(GoalList, RejectsADuplicateGoal) {
  GoalList goals = TwoGoals();
  EXPECT_FALSE(goals.Accept(IdOf(1), {3, 0}));
  EXPECT_EQ(goals.StatusOf(IdOf(9)), GoalStatus::kStatusUnknown);
}

TEST(GoalList, CancelsTheRequestedGoals) {
  using States = std::vector<GoalList::Status>;
  EXPECT_EQ(StatesAfter({}), (States{kCanceling, kCanceling}));
  EXPECT_EQ(StatesAfter({{{IdOf(2)}, {0, 0}}}), (States{kExecuting, kCanceling}));
  EXPECT_EQ(StatesAfter({{{}, {1, 0}}}), (States{kCanceling, kAccepted}));
  EXPECT_EQ(StatesAfter({{{IdOf(2)}, {1, 0}}}), (States{kCanceling, kCanceling}));
}

TEST(GoalList, ReportsWhyNoGoalIsCancelled) {
  GoalList goals = TwoGoals();
  EXPECT_EQ(goals.Cancel({{{IdOf(9)}, {0, 0}}}).return_code,
            CancelGoalResponse::kErrorUnknownGoalId);
  goals.Finish(IdOf(1), GoalStatus::kStatusSucceeded);
  EXPECT_EQ(goals.Cancel({{{IdOf(1)}, {0, 0}}}).return_code,
            CancelGoalResponse::kErrorGoalTerminated);
}

TEST(GoalList, IsBounded) {
  GoalList goals;
  for (std::uint8_t i = 1; i <= GoalList::kMaxGoals; ++i) EXPECT_TRUE(goals.Accept(IdOf(i), {}));
  EXPECT_FALSE(goals.Accept(IdOf(200), {}));
  for (std::uint8_t i = 1; i <= GoalList::kMaxGoals; ++i) {
    goals.Finish(IdOf(i), GoalStatus::kStatusSucceeded);
  }
  EXPECT_TRUE(goals.Accept(IdOf(200), {}));
  goals.Finish(IdOf(200), GoalStatus::kStatusSucceeded);
  EXPECT_EQ(goals.All().status_list.size(), GoalList::kMaxGoals);
  EXPECT_EQ(goals.StatusOf(IdOf(1)), GoalStatus::kStatusUnknown);
}

}  // namespace
}  // namespace gsv::ros2
