#include "gsv/simulation/faults/fault_injector.h"

#include <utility>

namespace gsv::simulation {
namespace {

using scenario::Fault;
using FaultKind = scenario::Fault::Kind;

base::Failure<base::Error> RefuseFault(base::ErrorCode code, const Fault& fault,
                                       const std::string& message) {
  return base::Fail(code, "cannot apply the fault: " + message, fault.source.text);
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
      return "the scenario moves the body";
    case FaultKind::kJointMoves:
      return "the scenario moves the joint";
  }
  return "";
}

bool IsOfSensor(FaultKind kind) {
  return kind == FaultKind::kSensorSilent || kind == FaultKind::kSensorError;
}

}  // namespace

base::Status FaultInjector::CheckOne(const Fault& fault, const world::Layout& layout) const {
  const auto refuse = [&](const std::string& message) {
    return RefuseFault(base::ErrorCode::kBadModel, fault, message);
  };
  const int index = layout.Find(fault.body);
  if (index < 0) return refuse("there is no body with the name \"" + fault.body + "\"");
  if (fault.kind == FaultKind::kBodyMoves) return {};
  const bool is_of_joint =
      fault.kind == FaultKind::kJointMoves || (!fault.part.empty() && !IsOfSensor(fault.kind));
  const world::Body& body = layout.bodies[static_cast<std::size_t>(index)];
  if (is_of_joint && (!body.is_rigid() || model::FindJoint(body.model->joints, fault.part) < 0)) {
    return refuse("\"" + fault.body + "\" has no joint \"" + fault.part +
                  "\" that rigid-body dynamics moves");
  }
  if (fault.kind == FaultKind::kJointMoves) return {};
  const AgentPopulation::AgentPtr agent = agents_.Find(fault.body);
  if (agent == nullptr) return refuse("\"" + fault.body + "\" is not a robot");
  if (fault.kind == FaultKind::kBehaviourDies && agent->behaviour() == nullptr) {
    return refuse("\"" + fault.body + "\" has no behaviour");
  }
  return {};
}

base::Status FaultInjector::Check() const {
  if (schedule_.all().empty()) return {};
  const auto layout = shared_->history.latest()->layout;
  for (const Fault& fault : schedule_.all()) {
    if (auto ok = CheckOne(fault, *layout); !ok) return ok;
  }
  return {};
}

base::Status FaultInjector::Inject(const Fault& fault) {
  base::Status applied = Apply(fault);
  events_.Emit("fault", fault.body,
               (fault.part.empty() ? "" : fault.part + ": ") +
                   (applied ? WhatHappens(fault.kind) : applied.error().Sentence()));
  return applied;
}

base::Status FaultInjector::Apply(const Fault& fault) {
  if (fault.kind == FaultKind::kBodyMoves) return MoveBody(fault);
  if (fault.kind == FaultKind::kJointMoves) return MoveJoint(fault);
  SimulationLock lock(*shared_);
  const AgentPopulation::AgentPtr agent = agents_.Find(fault.body);
  if (agent == nullptr) {
    return RefuseFault(base::ErrorCode::kNotFound, fault,
                       "the robot does not exist any more: " + fault.body);
  }
  if (IsOfSensor(fault.kind)) {
    lock.unlock();
    return FailSensor(fault, *agent);
  }
  if (fault.kind == FaultKind::kBehaviourDies) {
    agent->ReportDeath("the scenario contains this fault");
  } else if (fault.part.empty()) {
    agent->LoseMotor();
  } else {
    const world::Body& body = world_.layout()->bodies[static_cast<std::size_t>(agent->body())];
    // Faults are checked at the start of a run, but the name may now belong to a robot of another
    // model.
    const int joint = model::FindJoint(body.model->joints, fault.part);
    if (joint < 0 || !body.is_rigid()) {
      return RefuseFault(base::ErrorCode::kNotFound, fault,
                         "the joint does not exist any more: " + fault.part);
    }
    agent->LoseJoint(joint);
    world::CommandJoint(*world_.layout(), agent->body(), joint, {}, world_.state());
  }
  return {};
}

base::Status FaultInjector::FailSensor(const Fault& fault, RobotAgent& agent) {
  const auto sensor = agent.rack().Find(fault.part);
  if (!sensor) {
    return RefuseFault(base::ErrorCode::kBadModel, fault, sensor.error().Sentence());
  }
  const bool is_silent = fault.kind == FaultKind::kSensorSilent;
  (*sensor)->Fail(is_silent ? shared_->history.At((*sensor)->design().cadence) : nullptr);
  return {};
}

base::Status FaultInjector::MoveBody(const Fault& fault) {
  const int index = world_.layout()->Find(fault.body);
  if (index < 0) {
    return RefuseFault(base::ErrorCode::kNotFound, fault,
                       "the body does not exist any more: " + fault.body);
  }
  const world::Body before = world_.layout()->bodies[static_cast<std::size_t>(index)];
  // Faults may also move a part of the world, such as a door.
  const bool on_ground = !fault.place.z;
  if (auto ok = editor_.PlaceAny(index, fault.place.pose(), on_ground); !ok) {
    return RefuseFault(ok.error().code, fault, ok.error().Sentence());
  }
  if (before.is_static()) moved_from_.emplace(fault.body, before.initial_pose);
  const SimulationLock lock(*shared_);
  agents_.AssignBodies(*world_.layout());
  return {};
}

base::Status FaultInjector::MoveJoint(const Fault& fault) {
  const world::Layout& layout = *world_.layout();
  const int index = layout.Find(fault.body);
  const world::Body* const body =
      index < 0 ? nullptr : &layout.bodies[static_cast<std::size_t>(index)];
  const int joint = body == nullptr ? -1 : model::FindJoint(body->model->joints, fault.part);
  if (joint < 0) {
    return RefuseFault(base::ErrorCode::kNotFound, fault,
                       "the joint does not exist any more: " + fault.body + "/" + fault.part);
  }
  constexpr world::JointCommand::Kind kKinds[]{world::JointCommand::Kind::kPosition,
                                               world::JointCommand::Kind::kVelocity,
                                               world::JointCommand::Kind::kEffort};
  const world::JointCommand command{kKinds[static_cast<int>(fault.unit)], fault.target};
  if (auto ok = world::CheckJointCommand(*body, joint, command); !ok) {
    return RefuseFault(base::ErrorCode::kBadModel, fault, ok.error().Sentence());
  }
  world::CommandJoint(layout, index, joint, command, world_.state());
  return {};
}

base::Status FaultInjector::UndoMoves() {
  return editor_.SetInitialPoses(std::exchange(moved_from_, {}));
}

}  // namespace gsv::simulation
