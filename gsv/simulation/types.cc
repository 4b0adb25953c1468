#include "gsv/simulation/types.h"

namespace gsv::simulation {

const char* ToString(Mode mode) { return mode == Mode::kLockstep ? "lockstep" : "real_time"; }

const char* ToString(Phase phase) {
  switch (phase) {
    case Phase::kCreated:
      return "created";
    case Phase::kStarting:
      return "starting";
    case Phase::kRunning:
      return "running";
    case Phase::kPaused:
      return "paused";
    case Phase::kStopped:
      return "stopped";
    case Phase::kFinished:
      return "finished";
    case Phase::kFailed:
      return "failed";
  }
  return "";
}

const char* ToString(Edit::Kind kind) {
  switch (kind) {
    case Edit::Kind::kAddRobot:
      return "add_robot";
    case Edit::Kind::kAddAvatar:
      return "add_avatar";
    case Edit::Kind::kAddObject:
      return "add_object";
    case Edit::Kind::kRemove:
      return "remove";
    case Edit::Kind::kPlace:
      return "place";
    case Edit::Kind::kCommand:
      return "command";
  }
  return "";
}

const char* ToString(Edit::Moment moment) {
  switch (moment) {
    case Edit::Moment::kBeforeTurns:
      return "before_turns";
    case Edit::Moment::kAfterTurns:
      return "after_turns";
    case Edit::Moment::kAmidTurns:
      return "amid_turns";
  }
  return "";
}

const char* ToString(ExpectationState::Verdict verdict) {
  switch (verdict) {
    case ExpectationState::Verdict::kPending:
      return "pending";
    case ExpectationState::Verdict::kHolds:
      return "holds";
    case ExpectationState::Verdict::kViolated:
      return "violated";
  }
  return "";
}

const char* ToString(AgentPhase phase) {
  switch (phase) {
    case AgentPhase::kNone:
      return "none";
    case AgentPhase::kInitialised:
      return "initialised";
    case AgentPhase::kRunning:
      return "running";
    case AgentPhase::kWaiting:
      return "waiting";
    case AgentPhase::kFinished:
      return "finished";
    case AgentPhase::kUnresponsive:
      return "unresponsive";
    case AgentPhase::kDead:
      return "dead";
  }
  return "";
}

}  // namespace gsv::simulation
