// The goals of a ROS 2 action, and their states.
//
// Source   design.ros2.org, "Actions"; action_msgs of Jazzy.
// Threads  one at a time.
// Bounded  at most 100 unfinished goals, and the last 100 finished goals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gsv/messages/action_msgs.h"

namespace gsv::ros2 {

class GoalList {
 public:
  // The UUID that the client has given to a goal.
  using Id = std::array<std::uint8_t, 16>;
  using Status = std::int8_t;  // a constant of GoalStatus
  // Maximum number of unfinished goals, and of finished goals.
  static constexpr std::size_t kMaxGoals = 100;

  // Accepts a goal. Returns false if its id is already known, or if there are too many goals.
  bool Accept(const Id& id, const messages::builtin_interfaces::Time& stamp);
  // Returns STATUS_UNKNOWN if there is no such goal.
  Status StatusOf(const Id& id) const;
  bool IsFinished(const Id& id) const;
  // Starts to execute an accepted goal. Returns false if the goal is being cancelled.
  bool Begin(const Id& id);
  // Ends a goal with a final status.
  void Finish(const Id& id, Status status);

  // Marks the goals that the request selects as canceling. The response lists them.
  messages::action_msgs::CancelGoalResponse Cancel(
      const messages::action_msgs::CancelGoalRequest& request);

  // Returns the goals in the order in which they were accepted.
  messages::action_msgs::GoalStatusArray All() const { return {goals_}; }

 private:
  // Returns null if there is no such goal.
  messages::action_msgs::GoalStatus* Find(const Id& id);
  // Removes the oldest finished goals beyond kMaxGoals.
  void ForgetOldest();

  std::vector<messages::action_msgs::GoalStatus> goals_;
};

}  // namespace gsv::ros2
