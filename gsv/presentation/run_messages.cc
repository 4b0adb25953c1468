#include "gsv/presentation/run_messages.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "gsv/messages/time.h"

namespace gsv::presentation {
namespace {

using messages::diagnostic_msgs::DiagnosticStatus;
using messages::rcl_interfaces::Log;
using simulation::AgentPhase;

std::uint64_t Number(std::int64_t step) { return static_cast<std::uint64_t>(step); }

messages::gsv_msgs::RobotStatus RobotMessage(const simulation::RobotStatus& robot) {
  messages::gsv_msgs::RobotStatus message;
  message.name = robot.name;
  message.model = robot.model;
  message.behaviour = robot.behaviour;
  message.agent_state = simulation::ToString(robot.phase);
  message.detail = robot.detail;
  message.distance_m = robot.distance;
  message.collisions = robot.collisions;
  return message;
}

std::uint8_t LevelOfOutput(const simulation::Event& event) {
  if (event.kind == simulation::kStdoutEvent) return Log::kInfo;
  if (event.kind == simulation::kStderrEvent) return Log::kWarn;
  return event.detail.ends_with("exit code 0") ? Log::kInfo : Log::kError;
}

std::uint8_t LevelOf(std::string_view event) {
  if (event == "agent_dead" || event == "failed" || event == "expectation_violated") {
    return Log::kError;
  }
  if (event == "agent_unresponsive" || event == "behaviour_silent" || event == "robot_moved") {
    return Log::kWarn;
  }
  return Log::kInfo;
}

DiagnosticStatus Diagnosis(const simulation::SimulationStatus& status) {
  DiagnosticStatus diagnosis;
  diagnosis.name = "simulation";
  diagnosis.hardware_id = status.name;
  diagnosis.message = simulation::ToString(status.phase);
  if (status.phase == simulation::Phase::kFailed) {
    diagnosis.level = DiagnosticStatus::kError;
    diagnosis.message += ": " + status.failure;
  } else if (!status.waiting_for.empty()) {
    diagnosis.level = DiagnosticStatus::kWarn;
    diagnosis.message += ", waits for " + status.waiting_for;
  }
  diagnosis.values = {
      {"mode", simulation::ToString(status.mode)},
      {"step", std::to_string(status.step)},
      {"real-time factor", fmt::format("{:.4g}", status.real_time_factor)},
      {"target real-time factor", fmt::format("{:.4g}", status.target_factor)},
      {"late steps", std::to_string(status.late_steps)},
      {"mean step (us)",
       fmt::format("{:.4g}", 1e-3 * static_cast<double>(status.mean_step_time.count()))},
      {"robots", std::to_string(status.CountRobots())}};
  return diagnosis;
}

DiagnosticStatus Diagnosis(const simulation::RobotStatus& robot) {
  DiagnosticStatus diagnosis;
  diagnosis.name = robot.name;
  diagnosis.hardware_id = robot.model;
  if (robot.phase == AgentPhase::kDead) diagnosis.level = DiagnosticStatus::kError;
  if (robot.phase == AgentPhase::kUnresponsive) diagnosis.level = DiagnosticStatus::kWarn;
  diagnosis.message = simulation::ToString(robot.phase);
  if (!robot.detail.empty()) diagnosis.message += ": " + robot.detail;
  diagnosis.values = {{"behaviour", robot.behaviour},
                      {"distance (m)", fmt::format("{:.4g}", robot.distance)},
                      {"collisions", std::to_string(robot.collisions)}};
  for (const auto& [type, count] : robot.readings) {
    diagnosis.values.push_back({"readings of " + type, std::to_string(count)});
  }
  return diagnosis;
}

}  // namespace

messages::gsv_msgs::SimulationStatus StatusMessage(const simulation::SimulationStatus& status) {
  messages::gsv_msgs::SimulationStatus message;
  message.stamp = messages::ToMessage(status.time);
  message.step = Number(status.step);
  message.state = simulation::ToString(status.phase);
  message.mode = simulation::ToString(status.mode);
  message.real_time_factor = status.real_time_factor;
  message.target_factor = status.target_factor;
  message.late_steps = status.late_steps;
  message.waiting_for = status.waiting_for;
  message.robots.reserve(status.robots.size());
  for (const simulation::RobotStatus& robot : status.robots) {
    message.robots.push_back(RobotMessage(robot));
  }
  return message;
}

messages::gsv_msgs::LifecycleEvent EventMessage(const simulation::Event& event) {
  messages::gsv_msgs::LifecycleEvent message;
  message.stamp = messages::ToMessage(event.time);
  message.step = Number(event.step);
  message.event = event.kind;
  message.robot = event.robot;
  message.detail = event.detail;
  return message;
}

messages::rcl_interfaces::Log LogMessage(const simulation::Event& event) {
  messages::rcl_interfaces::Log message;
  message.stamp = messages::ToMessage(event.time);
  message.level = LevelOf(event.kind);
  message.name = event.robot.empty() ? "gsv" : event.robot;
  if (simulation::IsOutput(event)) {
    message.level = LevelOfOutput(event);
    message.msg = event.detail;
    if (event.kind != simulation::kProgramEndedEvent) message.file = event.kind;
    return message;
  }
  message.msg = event.kind;
  std::replace(message.msg.begin(), message.msg.end(), '_', ' ');
  if (!event.detail.empty()) message.msg += ": " + event.detail;
  return message;
}

messages::diagnostic_msgs::DiagnosticArray DiagnosticsMessage(
    const simulation::SimulationStatus& status) {
  messages::diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = messages::ToMessage(status.time);
  message.status.reserve(1 + status.robots.size());
  message.status.push_back(Diagnosis(status));
  for (const simulation::RobotStatus& robot : status.robots) {
    message.status.push_back(Diagnosis(robot));
  }
  return message;
}

}  // namespace gsv::presentation
