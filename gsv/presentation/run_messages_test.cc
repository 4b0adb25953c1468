#include "gsv/presentation/run_messages.h"

#include <gtest/gtest.h>

namespace gsv::presentation {
namespace {

using messages::diagnostic_msgs::DiagnosticStatus;
using messages::rcl_interfaces::Log;
using simulation::AgentPhase;
using std::chrono::milliseconds;

simulation::Event Event(std::string kind, std::string robot, std::string detail) {
  return {150, milliseconds(1500), std::move(kind), std::move(robot), std::move(detail)};
}

TEST(LogMessage, NamesTheEventAndTheRobot) {
  const Log line = LogMessage(Event("agent_dead", "robot_3", "wander on host: exit code 1"));
  EXPECT_EQ(line.name, "robot_3");
  EXPECT_EQ(line.msg, "agent dead: wander on host: exit code 1");
  EXPECT_EQ(line.level, Log::kError);
  EXPECT_EQ(line.stamp.sec, 1);
  EXPECT_EQ(line.stamp.nanosec, 500'000'000u);
}

TEST(LogMessage, LevelFollowsFromTheEvent) {
  EXPECT_EQ(LogMessage(Event("failed", "", "")).level, Log::kError);
  EXPECT_EQ(LogMessage(Event("agent_unresponsive", "a", "")).level, Log::kWarn);
  EXPECT_EQ(LogMessage(Event("robot_moved", "a", "")).level, Log::kWarn);
  const Log started = LogMessage(Event("started", "", ""));
  EXPECT_EQ(started.level, Log::kInfo);
  EXPECT_EQ(started.name, "gsv");
  EXPECT_EQ(started.msg, "started");
}

simulation::SimulationStatus Running() {
  simulation::SimulationStatus status;
  status.name = "office";
  status.phase = simulation::Phase::kRunning;
  status.step = 150;
  status.time = milliseconds(1500);
  status.real_time_factor = 0.998;
  status.late_steps = 2;
  return status;
}

std::string ValueOf(const DiagnosticStatus& diagnosis, const std::string& key) {
  for (const auto& value : diagnosis.values) {
    if (value.key == key) return value.value;
  }
  return "no " + key;
}

TEST(DiagnosticsMessage, LevelIsOkForAHealthyRun) {
  const auto message = DiagnosticsMessage(Running());
  EXPECT_EQ(message.header.stamp.sec, 1);
  ASSERT_EQ(message.status.size(), 1u);
  const DiagnosticStatus& simulation = message.status[0];
  EXPECT_EQ(simulation.level, DiagnosticStatus::kOk);
  EXPECT_EQ(simulation.name, "simulation");
  EXPECT_EQ(simulation.hardware_id, "office");
  EXPECT_EQ(simulation.message, "running");
  EXPECT_EQ(ValueOf(simulation, "step"), "150");
  EXPECT_EQ(ValueOf(simulation, "real-time factor"), "0.998");
  EXPECT_EQ(ValueOf(simulation, "late steps"), "2");
}

TEST(DiagnosticsMessage, SlowBehaviourIsAWarningAndAFailureAnError) {
  simulation::SimulationStatus status = Running();
  status.waiting_for = "b (slow) since 2.1 s";
  const DiagnosticStatus held = DiagnosticsMessage(status).status[0];
  EXPECT_EQ(held.level, DiagnosticStatus::kWarn);
  EXPECT_EQ(held.message, "running, waits for b (slow) since 2.1 s");
  status.phase = simulation::Phase::kFailed;
  status.failure = "a crashed";
  const DiagnosticStatus failed = DiagnosticsMessage(status).status[0];
  EXPECT_EQ(failed.level, DiagnosticStatus::kError);
  EXPECT_EQ(failed.message, "failed: a crashed");
}

TEST(DiagnosticsMessage, LevelOfARobotIsThatOfItsBehaviour) {
  simulation::SimulationStatus status = Running();
  simulation::RobotStatus robot;
  robot.model = "pebble";
  for (const AgentPhase phase :
       {AgentPhase::kWaiting, AgentPhase::kUnresponsive, AgentPhase::kDead}) {
    robot.name = simulation::ToString(phase);
    robot.phase = phase;
    status.robots.push_back(robot);
  }
  status.robots[2].detail = "exit code 1";
  status.robots[0].readings = {{"sonar", 8}};
  const auto message = DiagnosticsMessage(status);
  ASSERT_EQ(message.status.size(), 4u);
  EXPECT_EQ(message.status[1].level, DiagnosticStatus::kOk);
  EXPECT_EQ(message.status[1].hardware_id, "pebble");
  EXPECT_EQ(ValueOf(message.status[1], "readings of sonar"), "8");
  EXPECT_EQ(message.status[2].level, DiagnosticStatus::kWarn);
  EXPECT_EQ(message.status[3].level, DiagnosticStatus::kError);
  EXPECT_EQ(message.status[3].message, "dead: exit code 1");
}

}  // namespace
}  // namespace gsv::presentation
