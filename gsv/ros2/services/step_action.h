// Offers the action SimulateSteps: takes steps one by one, with feedback after each.
//
// Threads  handlers run on the quick lane, and steps on the stepping lane.
#pragma once

#include <map>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/ros2/services/goal_list.h"
#include "gsv/ros2/services/simulation_services.h"

namespace gsv::ros2 {

// The server of the action SimulateSteps.
class StepAction {
 public:
  // `served` and this object must outlive the host of the services.
  explicit StepAction(ServedSimulation& served);

 private:
  // The result of a goal, with its final status.
  using Outcome = messages::simulation_interfaces::SimulateStepsGetResultResponse;

  // Accepts or refuses a goal, and starts its execution on the stepping lane.
  messages::simulation_interfaces::SimulateStepsSendGoalResponse Accept(
      const messages::simulation_interfaces::SimulateStepsSendGoalRequest& request);
  // Sends the outcome of a goal, at once or when the goal is finished.
  void GiveResult(const GoalList::Id& id, const ServiceHost::Replier& reply);
  // Executes a goal to its end, on the stepping lane.
  void Execute(const GoalList::Id& id, std::uint64_t steps);
  // Takes the steps. Returns the number of steps taken and, if this is less than `steps`, the
  // reason.
  Outcome Take(simulation::Simulation& simulation, const GoalList::Id& id, std::uint64_t steps);
  // Publishes the progress of a goal.
  void SendFeedback(const GoalList::Id& id, std::uint64_t completed, std::uint64_t remaining);
  // Stores the outcome, and sends it to the clients that wait for it.
  void Finish(const GoalList::Id& id, const Outcome& outcome);
  // Publishes the states of all goals.
  void SendStatus() GSV_REQUIRES(mutex_);
  // Whether a client has cancelled the goal.
  bool IsCanceled(const GoalList::Id& id) const;

  ServedSimulation& served_;         // the simulation that takes the steps
  dds::Writer* feedback_ = nullptr;  // null if the participant refused to create the writer
  dds::Writer* status_ = nullptr;    // writer of the topic "status"; the host owns it
  mutable base::Mutex mutex_;
  GoalList goals_ GSV_GUARDED_BY(mutex_);
  std::map<GoalList::Id, Outcome> outcomes_ GSV_GUARDED_BY(mutex_);  // outcomes of finished goals
  // Clients that wait for the result of an unfinished goal.
  std::multimap<GoalList::Id, ServiceHost::Replier> waiting_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::ros2
