#include "gsv/health/health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace gsv::health {
namespace {

using simulation::AgentPhase;
using simulation::Phase;

constexpr base::SimTime kStandsLong = std::chrono::seconds(10);
constexpr std::chrono::nanoseconds kLateAfter = std::chrono::seconds(1);

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// Returns a text such as "0", "0.3 m/s" or "0.3 m/s and -0.5 rad/s".
std::string CommandText(const world::DriveCommand& command) {
  std::string text;
  const auto add = [&](double value, const char* unit) {
    if (value == 0) return;
    text += (text.empty() ? "" : " and ") + Number(value) + unit;
  };
  add(command.linear, " m/s");
  add(command.lateral, " m/s to the left");
  add(command.angular, " rad/s");
  return text.empty() ? "0" : text;
}

bool IsOver(Phase phase) {
  return phase == Phase::kFinished || phase == Phase::kStopped || phase == Phase::kFailed;
}

State StateOf(const simulation::RobotStatus& robot, const simulation::SimulationStatus& status) {
  if (robot.phase == AgentPhase::kDead) return State::kDead;
  if (robot.phase == AgentPhase::kUnresponsive) return State::kLate;
  if (status.phase == Phase::kRunning && robot.running_for >= kLateAfter) return State::kLate;
  if (robot.motion.is_stuck) return State::kStuck;
  if (!robot.motion.contact.empty()) return State::kContact;
  return robot.motion.is_moving ? State::kMoving : State::kStanding;
}

base::SimTime SinceOf(State state, const simulation::RobotStatus& robot,
                      const simulation::SimulationStatus& status) {
  switch (state) {
    case State::kDead:
      return robot.detail_since;
    case State::kLate:
      return robot.phase == AgentPhase::kUnresponsive ? robot.detail_since : status.time;
    case State::kContact:
      return robot.motion.contact_since;
    default:
      return robot.motion.since;
  }
}

const char* SummaryOf(State state) {
  switch (state) {
    case State::kMoving:
      return "has been moving";
    case State::kStanding:
      return "has not moved";
    case State::kStuck:
      return "has been stuck";
    case State::kContact:
      return "has been in contact";
    case State::kLate:
      return "has been late";
    case State::kDead:
      return "has been dead";
  }
  return "";
}

std::string ReasonOf(State state, const simulation::RobotStatus& robot,
                     const simulation::SimulationStatus& status) {
  const simulation::Motion& motion = robot.motion;
  const std::string behaviour = "its behaviour " + robot.behaviour;
  if (state == State::kDead) {
    const std::string& why = robot.cause.empty() ? robot.detail : robot.cause;
    return behaviour + " died" + (why.empty() ? "" : ": " + why);
  }
  if (state == State::kLate) {
    if (robot.phase == AgentPhase::kUnresponsive) return behaviour + " " + robot.detail;
    return status.mode == simulation::Mode::kLockstep
               ? "the simulation waits for " + behaviour
               : behaviour + " runs without calling a wait function";
  }
  if (state == State::kMoving) return "commanded " + CommandText(motion.command);
  const bool has_command = motion.command != world::DriveCommand{};
  std::string reason = "commanded " + CommandText(motion.command);
  if (!has_command && robot.is_avatar) reason += " (an avatar)";
  if (!has_command && !robot.is_avatar && robot.behaviour.empty()) {
    // A user or a ROS 2 node may command a robot without a behaviour. So the reason states that
    // there is neither a behaviour nor a command.
    reason = "it has no behaviour, and no command to move";
  }
  if (!motion.contact.empty()) reason += ", touches " + motion.contact;
  // All behaviours end when the run ends, so an ended behaviour is no problem then.
  const bool has_ended = robot.phase == AgentPhase::kFinished && !IsOver(status.phase);
  if (!has_command && has_ended) reason += ", " + behaviour + " has ended";
  return reason;
}

Level LevelOf(const RobotHealth& health, const simulation::RobotStatus& robot,
              const simulation::SimulationStatus& status) {
  if (health.state == State::kMoving) return Level::kFine;
  if (health.state == State::kDead) return Level::kError;
  if (health.state != State::kStanding) return Level::kWarning;
  const bool has_behaviour =
      !robot.behaviour.empty() && (IsOver(status.phase) || robot.phase == AgentPhase::kRunning ||
                                   robot.phase == AgentPhase::kWaiting);
  return has_behaviour && status.time - health.since >= kStandsLong ? Level::kWarning
                                                                    : Level::kFine;
}

double Rounded(double value) { return std::round(value * 100) / 100 + 0.0; }

std::string Duration(base::SimTime duration) {
  const double seconds = base::ToSeconds(duration);
  char text[32];
  std::snprintf(text, sizeof text, seconds < 10 ? "%.1f s" : "%.0f s", seconds);
  return text;
}

}  // namespace

const char* ToString(State state) {
  switch (state) {
    case State::kMoving:
      return "moving";
    case State::kStanding:
      return "standing";
    case State::kStuck:
      return "stuck";
    case State::kContact:
      return "contact";
    case State::kLate:
      return "late";
    case State::kDead:
      return "dead";
  }
  return "";
}

std::optional<State> StateOf(std::string_view name) {
  for (std::size_t i = 0; i < kStates; ++i) {
    if (name == ToString(static_cast<State>(i))) return static_cast<State>(i);
  }
  return std::nullopt;
}

int Severity(State state, Level level) {
  constexpr std::array kFromBest{State::kMoving,  State::kStanding, State::kLate,
                                 State::kContact, State::kStuck,    State::kDead};
  const auto place = std::find(kFromBest.begin(), kFromBest.end(), state) - kFromBest.begin();
  return 3 * static_cast<int>(place) + static_cast<int>(level);
}

RobotHealth HealthOf(const simulation::RobotStatus& robot,
                     const simulation::SimulationStatus& status) {
  RobotHealth health;
  health.robot = robot.name;
  health.state = StateOf(robot, status);
  health.since = SinceOf(health.state, robot, status);
  health.command = robot.motion.command;
  health.linear = Rounded(robot.motion.linear);
  health.angular = Rounded(robot.motion.angular);
  health.contact = robot.motion.contact;
  health.summary = SummaryOf(health.state);
  health.reason = ReasonOf(health.state, robot, status);
  health.level = LevelOf(health, robot, status);
  return health;
}

void SetLimit(std::optional<Limit> limit, RobotHealth& health) {
  health.limit = std::move(limit);
  if (!health.limit) return;
  char text[64] = " reads less than its minimum range";  // -inf, see REP 117
  if (std::isfinite(health.limit->value)) {
    std::snprintf(text, sizeof text, " reads %.2f m", health.limit->value);
  }
  health.reason += (health.reason.empty() ? "" : ", ") + health.limit->sensor + text;
}

std::string Sentence(const RobotHealth& health, base::SimTime now) {
  const base::SimTime duration = now > health.since ? now - health.since : base::SimTime(0);
  std::string text = health.summary;
  if (health.state != State::kLate || duration > base::SimTime(0)) {
    text += " for " + Duration(duration);
  }
  return health.reason.empty() ? text : text + ": " + health.reason;
}

std::string FinalSentence(const RobotHealth& health) {
  char from[64];
  std::snprintf(from, sizeof from, " from %.1f s", base::ToSeconds(health.since));
  const auto with_reason = [&](const std::string& what) {
    return what + (health.reason.empty() ? "" : ": " + health.reason);
  };
  switch (health.state) {
    case State::kMoving:
      return {};
    case State::kStanding:
      return with_reason(std::string("stood still") + from);
    case State::kStuck:
      return with_reason(std::string("was stuck") + from);
    case State::kContact:
      return with_reason(std::string("was in contact") + from);
    case State::kLate:
      return with_reason("was late");
    case State::kDead:
      return with_reason(std::string("was dead") + from);
  }
  return {};
}

std::string Summary(const Report& report) {
  constexpr std::array<std::pair<const char*, const char*>, kStates> kWords{
      {{"moves", "move"},
       {"stands", "stand"},
       {"is stuck", "are stuck"},
       {"is in contact", "are in contact"},
       {"is late", "are late"},
       {"is dead", "are dead"}}};
  std::string text;
  for (std::size_t i = 0; i < kStates; ++i) {
    const std::uint32_t count = report.counts[i];
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " +
            (count == 1 ? kWords[i].first : kWords[i].second);
  }
  return text;
}

}  // namespace gsv::health
