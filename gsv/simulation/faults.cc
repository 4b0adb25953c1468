// What goes wrong because a scenario says so (scenario/fault.h). A fault happens between two steps,
// at the first instant at or after its time, before anybody is woken or reads there: its place in a
// run depends on nothing else.
#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {
namespace {

using scenario::Fault;
using FaultKind = scenario::Fault::Kind;

tl::unexpected<base::Error> RefuseFault(base::ErrorCode code, const Fault& fault,
                                        std::string message) {
  return base::Fail(code, "the fault cannot happen: " + std::move(message), fault.source.text);
}

const char* WhatHappens(FaultKind kind) {
  switch (kind) {
    case FaultKind::kSensorSilent:
      return "the sensor falls silent";
    case FaultKind::kSensorError:
      return "the sensor fails";
    case FaultKind::kBehaviourDies:
      return "the behaviour dies";
    case FaultKind::kMotorFails:
      return "the motor fails";
    case FaultKind::kBodyMoves:
      return "it is put elsewhere";
    case FaultKind::kJointMoves:
      return "the joint is moved";
  }
  return "";
}

}  // namespace

// Under shared_->mutex.
base::Status SteppingSimulation::CheckFaults() const {
  const auto layout = shared_->history.latest()->layout;
  for (const Fault& fault : faults_) {
    const auto refuse = [&](const std::string& message) {
      return RefuseFault(base::ErrorCode::kBadModel, fault, message);
    };
    const int body = layout->Find(fault.body);
    if (body < 0) return refuse("there is nothing called \"" + fault.body + "\"");
    if (fault.kind == FaultKind::kBodyMoves) continue;
    if (fault.kind == FaultKind::kJointMoves || !fault.part.empty()) {
      const world::Body& known = layout->bodies[body];
      const bool is_sensor =
          fault.kind == FaultKind::kSensorSilent || fault.kind == FaultKind::kSensorError;
      if (!is_sensor &&
          (model::FindJoint(known.model->joints, fault.part) < 0 || !known.is_rigid())) {
        return refuse("\"" + fault.body + "\" has no joint \"" + fault.part +
                      "\" that forces move");
      }
    }
    if (fault.kind == FaultKind::kJointMoves) continue;
    const auto agent = agents_.find(fault.body);
    if (agent == agents_.end()) return refuse("\"" + fault.body + "\" is no robot");
    if (fault.kind == FaultKind::kBehaviourDies && agent->second->behaviour() == nullptr) {
      return refuse("\"" + fault.body + "\" has no behaviour");
    }
  }
  return {};
}

// Under shared_->mutex.
bool SteppingSimulation::IsFaultDue() const {
  return faults_done_ < faults_.size() &&
         base::FromSeconds(faults_[faults_done_].at) <= shared_->now;
}

void SteppingSimulation::ApplyFaults() {
  const std::lock_guard world_lock(world_mutex_);
  for (;;) {
    Fault fault;
    {
      const std::lock_guard lock(shared_->mutex);
      if (shared_->phase != Phase::kRunning || !IsFaultDue()) return;
      fault = faults_[faults_done_++];
    }
    const base::Status applied = Apply(fault);
    AddEvent("fault", fault.body,
             (fault.part.empty() ? "" : fault.part + ": ") +
                 (applied ? WhatHappens(fault.kind) : applied.error().Sentence()));
    if (applied) continue;
    const std::lock_guard lock(shared_->mutex);
    if (shared_->phase == Phase::kRunning) Fail(applied.error().Sentence());
    return;
  }
}

base::Status SteppingSimulation::Apply(const Fault& fault) {
  if (fault.kind == FaultKind::kBodyMoves) return MoveBody(fault);
  if (fault.kind == FaultKind::kJointMoves) return MoveJoint(fault);
  const AgentPtr agent = FindAgent(fault.body);
  if (agent == nullptr) {
    return RefuseFault(base::ErrorCode::kNotFound, fault, "the robot is gone: " + fault.body);
  }
  const bool is_silent = fault.kind == FaultKind::kSensorSilent;
  if (is_silent || fault.kind == FaultKind::kSensorError) {
    const auto sensor = agent->rack().Find(fault.part);
    if (!sensor) return RefuseFault(base::ErrorCode::kBadModel, fault, sensor.error().Sentence());
    (*sensor)->Fail(is_silent ? shared_->history.At((*sensor)->design().cadence) : nullptr);
    return {};
  }
  const std::lock_guard lock(shared_->mutex);
  if (fault.kind == FaultKind::kBehaviourDies) {
    agent->ReportDeath("the scenario has it die");
  } else if (fault.part.empty()) {
    agent->LoseMotor();
  } else {
    const int joint = model::FindJoint(layout_->bodies[agent->body()].model->joints, fault.part);
    agent->LoseJoint(joint);
    world::CommandJoint(*layout_, agent->body(), joint, {}, state_);
  }
  return {};
}

// A door that is part of the world may be moved as well: the world is made ready anew.
base::Status SteppingSimulation::MoveBody(const Fault& fault) {
  const int body = layout_->Find(fault.body);
  if (body < 0) return RefuseFault(base::ErrorCode::kNotFound, fault, "it is gone: " + fault.body);
  std::vector<world::Body> bodies = layout_->bodies;
  world::Body& moved = bodies[body];
  const geometry::Pose before = moved.initial_pose;
  moved.initial_pose =
      fault.place.z ? fault.place.pose() : StandingPose(*moved.model, fault.place.pose(), body);
  const bool is_static = moved.is_static();
  if (auto ok = ChangeLayout(std::move(bodies), {fault.body}); !ok) {
    return RefuseFault(ok.error().code, fault, ok.error().Sentence());
  }
  if (is_static) stood_at_.emplace(fault.body, before);
  const std::lock_guard lock(shared_->mutex);
  IndexAgents();
  return {};
}

base::Status SteppingSimulation::MoveJoint(const Fault& fault) {
  const int body = layout_->Find(fault.body);
  const int joint =
      body < 0 ? -1 : model::FindJoint(layout_->bodies[body].model->joints, fault.part);
  if (joint < 0) return RefuseFault(base::ErrorCode::kNotFound, fault, "it is gone: " + fault.body);
  constexpr world::JointCommand::Kind kKinds[]{world::JointCommand::Kind::kPosition,
                                               world::JointCommand::Kind::kVelocity,
                                               world::JointCommand::Kind::kEffort};
  const world::JointCommand command{kKinds[static_cast<int>(fault.unit)], fault.target};
  if (auto ok = world::CheckJointCommand(layout_->bodies[body], joint, command); !ok) {
    return RefuseFault(base::ErrorCode::kBadModel, fault, ok.error().Sentence());
  }
  world::CommandJoint(*layout_, body, joint, command, state_);
  return {};
}

// Under world_mutex_.
base::Status SteppingSimulation::UndoFaults() {
  {
    const std::lock_guard lock(shared_->mutex);
    faults_done_ = 0;
  }
  if (stood_at_.empty()) return {};
  std::vector<world::Body> bodies = layout_->bodies;
  for (world::Body& body : bodies) {
    const auto stood = stood_at_.find(body.name);
    if (stood != stood_at_.end()) body.initial_pose = stood->second;
  }
  stood_at_.clear();
  return ChangeLayout(std::move(bodies), {});
}

}  // namespace gsv::simulation
