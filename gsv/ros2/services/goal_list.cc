#include "gsv/ros2/services/goal_list.h"

#include <algorithm>
#include <utility>

namespace gsv::ros2 {
namespace {

using messages::action_msgs::CancelGoalRequest;
using messages::action_msgs::CancelGoalResponse;
using messages::action_msgs::GoalInfo;
using messages::action_msgs::GoalStatus;
using messages::builtin_interfaces::Time;

bool IsFinal(GoalList::Status status) { return status >= GoalStatus::kStatusSucceeded; }

bool IsNotAfter(const Time& a, const Time& b) {
  return std::pair(a.sec, a.nanosec) <= std::pair(b.sec, b.nanosec);
}

// Whether `request` selects `goal`. A request names one goal, all goals up to an instant, or both.
// A request with neither selects all goals.
bool IsMeant(const CancelGoalRequest& request, const GoalInfo& goal) {
  const bool has_id = request.goal_info.goal_id.uuid != GoalList::Id{};
  const bool has_stamp = request.goal_info.stamp != Time{};
  if (!has_id && !has_stamp) return true;
  return (has_id && goal.goal_id == request.goal_info.goal_id) ||
         (has_stamp && IsNotAfter(goal.stamp, request.goal_info.stamp));
}

}  // namespace

GoalStatus* GoalList::Find(const Id& id) {
  const auto found = std::find_if(goals_.begin(), goals_.end(), [&](const GoalStatus& goal) {
    return goal.goal_info.goal_id.uuid == id;
  });
  return found == goals_.end() ? nullptr : &*found;
}

bool GoalList::Accept(const Id& id, const Time& stamp) {
  const auto unfinished = std::count_if(
      goals_.begin(), goals_.end(), [](const GoalStatus& goal) { return !IsFinal(goal.status); });
  if (Find(id) != nullptr || static_cast<std::size_t>(unfinished) >= kMaxGoals) return false;
  goals_.push_back({{{id}, stamp}, GoalStatus::kStatusAccepted});
  return true;
}

GoalList::Status GoalList::StatusOf(const Id& id) const {
  const GoalStatus* const goal = const_cast<GoalList*>(this)->Find(id);
  return goal == nullptr ? GoalStatus::kStatusUnknown : goal->status;
}

bool GoalList::IsFinished(const Id& id) const { return IsFinal(StatusOf(id)); }

bool GoalList::Begin(const Id& id) {
  GoalStatus* const goal = Find(id);
  if (goal == nullptr || goal->status != GoalStatus::kStatusAccepted) return false;
  goal->status = GoalStatus::kStatusExecuting;
  return true;
}

void GoalList::Finish(const Id& id, Status status) {
  if (GoalStatus* const goal = Find(id)) goal->status = status;
  ForgetOldest();
}

void GoalList::ForgetOldest() {
  const auto is_final = [](const GoalStatus& goal) { return IsFinal(goal.status); };
  while (static_cast<std::size_t>(std::count_if(goals_.begin(), goals_.end(), is_final)) >
         kMaxGoals) {
    goals_.erase(std::find_if(goals_.begin(), goals_.end(), is_final));
  }
}

CancelGoalResponse GoalList::Cancel(const CancelGoalRequest& request) {
  CancelGoalResponse response;
  const bool has_id = request.goal_info.goal_id.uuid != Id{};
  const GoalStatus* const named = has_id ? Find(request.goal_info.goal_id.uuid) : nullptr;
  for (GoalStatus& goal : goals_) {
    if (IsFinal(goal.status) || !IsMeant(request, goal.goal_info)) continue;
    goal.status = GoalStatus::kStatusCanceling;
    response.goals_canceling.push_back(goal.goal_info);
  }
  if (!response.goals_canceling.empty() || !has_id) return response;
  response.return_code = named == nullptr ? CancelGoalResponse::kErrorUnknownGoalId
                                          : CancelGoalResponse::kErrorGoalTerminated;
  return response;
}

}  // namespace gsv::ros2
