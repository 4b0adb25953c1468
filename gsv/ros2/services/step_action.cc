#include "gsv/ros2/services/step_action.h"

#include "gsv/messages/time.h"
#include "gsv/ros2/services/run_services.h"

namespace gsv::ros2 {
namespace {

namespace interfaces = messages::simulation_interfaces;
using messages::action_msgs::CancelGoalRequest;
using messages::action_msgs::GoalStatus;
using simulation::Phase;
using Lane = ServiceHost::Lane;

constexpr std::size_t kMaxWaitingResults = 1000;
constexpr const char* kAction = "/simulate_steps/_action/";
constexpr dds::Qos kFeedbackQos{.depth = 10};
constexpr dds::Qos kStatusQos{.is_transient_local = true, .depth = 1};

void SendTo(dds::Writer* writer, const messages::Bytes& bytes) {
  if (writer != nullptr) writer->Write(bytes);
}

}  // namespace

StepAction::StepAction(ServedSimulation& served) : served_(served) {
  const std::string name = served.node + kAction;
  ServiceHost& host = served.host;
  feedback_ =
      host.Advertise(name + "feedback",
                     "simulation_interfaces/action/SimulateSteps_FeedbackMessage", kFeedbackQos);
  status_ = host.Advertise(name + "status", "action_msgs/msg/GoalStatusArray", kStatusQos);
  host.Offer<interfaces::SimulateStepsSendGoalRequest>(
      name + "send_goal", "simulation_interfaces/action/SimulateSteps_SendGoal", Lane::kQuick,
      [this](const interfaces::SimulateStepsSendGoalRequest& request) { return Accept(request); });
  host.OfferLater<interfaces::SimulateStepsGetResultRequest>(
      name + "get_result", "simulation_interfaces/action/SimulateSteps_GetResult", Lane::kQuick,
      [this](const interfaces::SimulateStepsGetResultRequest& request,
             const ServiceHost::Replier& reply) { GiveResult(request.goal_id.uuid, reply); });
  host.Offer<CancelGoalRequest>(name + "cancel_goal", "action_msgs/srv/CancelGoal", Lane::kQuick,
                                [this](const CancelGoalRequest& request) {
                                  const base::MutexLock lock(mutex_);
                                  auto response = goals_.Cancel(request);
                                  SendStatus();
                                  return response;
                                });
}

interfaces::SimulateStepsSendGoalResponse StepAction::Accept(
    const interfaces::SimulateStepsSendGoalRequest& request) {
  interfaces::SimulateStepsSendGoalResponse response;
  const auto simulation = served_.simulation();
  if (simulation == nullptr) return response;
  response.stamp = messages::ToMessage(simulation->snapshot()->state.time);
  const GoalList::Id id = request.goal_id.uuid;
  const base::MutexLock lock(mutex_);
  if (!goals_.Accept(id, response.stamp)) return response;
  response.accepted = served_.host.Submit(
      Lane::kStepping, [this, id, steps = request.goal.steps] { Execute(id, steps); });
  if (!response.accepted) goals_.Finish(id, GoalStatus::kStatusAborted);
  SendStatus();
  return response;
}

void StepAction::GiveResult(const GoalList::Id& id, const ServiceHost::Replier& reply) {
  const base::MutexLock lock(mutex_);
  const bool waits = goals_.StatusOf(id) != GoalStatus::kStatusUnknown && !goals_.IsFinished(id);
  if (waits && waiting_.size() < kMaxWaitingResults) {
    waiting_.emplace(id, reply);
    return;
  }
  const auto outcome = outcomes_.find(id);
  reply.SendMessage(outcome == outcomes_.end() ? Outcome{} : outcome->second);
}

void StepAction::Execute(const GoalList::Id& id, std::uint64_t steps) {
  {
    const base::MutexLock lock(mutex_);
    (void)goals_.Begin(id);
    SendStatus();
  }
  if (const auto simulation = served_.simulation()) {
    Finish(id, Take(*simulation, id, steps));
    return;
  }
  Outcome outcome;
  outcome.status = GoalStatus::kStatusAborted;
  outcome.result.result = served_.NoSimulation();
  Finish(id, outcome);
}

StepAction::Outcome StepAction::Take(simulation::Simulation& simulation, const GoalList::Id& id,
                                     std::uint64_t steps) {
  Outcome outcome;
  const auto ended = [&](std::int8_t status, std::string why) {
    outcome.status = status;
    outcome.result.result = Failed(interfaces::Result::kResultOperationFailed, std::move(why));
    return outcome;
  };
  const Phase phase = PhaseOf(simulation);
  if (phase != Phase::kCreated && phase != Phase::kPaused) {
    return ended(GoalStatus::kStatusAborted,
                 std::string("the simulation must be paused, and it is ") + ToString(phase));
  }
  for (std::uint64_t taken = 0; taken < steps; ++taken) {
    if (IsCanceled(id)) {
      return ended(GoalStatus::kStatusCanceled, "canceled after " + std::to_string(taken) + " of " +
                                                    std::to_string(steps) + " steps");
    }
    const base::Status ok = TakeSteps(simulation, 1, [this] { return served_.host.is_stopping(); });
    if (!ok) return ended(GoalStatus::kStatusAborted, ok.error().Sentence());
    SendFeedback(id, taken + 1, steps - taken - 1);
  }
  outcome.status = GoalStatus::kStatusSucceeded;
  outcome.result.result = Succeeded();
  return outcome;
}

void StepAction::SendFeedback(const GoalList::Id& id, std::uint64_t completed,
                              std::uint64_t remaining) {
  if (feedback_ == nullptr || !feedback_->has_readers()) return;
  messages::Bytes bytes;
  messages::Encode(interfaces::SimulateStepsFeedbackMessage{{id}, {completed, remaining}}, bytes);
  SendTo(feedback_, bytes);
}

void StepAction::Finish(const GoalList::Id& id, const Outcome& outcome) {
  const base::MutexLock lock(mutex_);
  goals_.Finish(id, outcome.status);
  outcomes_[id] = outcome;
  std::erase_if(outcomes_, [this](const auto& each) GSV_REQUIRES(mutex_) {
    return goals_.StatusOf(each.first) == GoalStatus::kStatusUnknown;
  });
  SendStatus();
  const auto [begin, end] = waiting_.equal_range(id);
  for (auto each = begin; each != end; ++each) each->second.SendMessage(outcome);
  waiting_.erase(begin, end);
}

bool StepAction::IsCanceled(const GoalList::Id& id) const {
  const base::MutexLock lock(mutex_);
  return goals_.StatusOf(id) == GoalStatus::kStatusCanceling;
}

void StepAction::SendStatus() {
  messages::Bytes bytes;
  messages::Encode(goals_.All(), bytes);
  SendTo(status_, bytes);
}

}  // namespace gsv::ros2
