#include "apps/gsv/running/run_report.h"

#include <cstdio>

#include <nlohmann/json.hpp>

namespace gsv::app {
namespace {

using nlohmann::ordered_json;

double Seconds(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }

const char* BehaviourText(const simulation::RobotStatus& robot) {
  if (!robot.behaviour.empty()) return robot.behaviour.c_str();
  return robot.is_station ? "(station)" : "-";
}

ordered_json RobotJson(const simulation::RobotStatus& robot) {
  const geometry::Pose& pose = robot.world_from_robot;
  ordered_json readings = ordered_json::object();
  for (const auto& [type, count] : robot.readings) readings[type] = count;
  ordered_json json{{"name", robot.name},
                    {"model", robot.model},
                    {"behaviour", robot.behaviour},
                    {"agent", ToString(robot.phase)},
                    {"pose",
                     {{"x_m", pose.position.x},
                      {"y_m", pose.position.y},
                      {"z_m", pose.position.z},
                      {"yaw_rad", geometry::Yaw(pose.orientation)}}},
                    {"distance_m", robot.distance},
                    {"collisions", robot.collisions},
                    {"readings", std::move(readings)}};
  if (robot.is_station) json["is_station"] = true;
  return json;
}

ordered_json FindingJson(const verdict::Finding& finding) {
  ordered_json measured = ordered_json::array();
  for (const verdict::MeasuredAtom& atom : finding.atoms) {
    ordered_json entry{{"what", verdict::Describe(atom.atom.quantity)}};
    if (atom.was_measured) {
      entry.update({{"lowest", atom.lowest},
                    {"lowest_s", atom.lowest_at},
                    {"highest", atom.highest},
                    {"highest_s", atom.highest_at},
                    {"last", atom.last}});
    }
    measured.push_back(std::move(entry));
  }
  return {{"name", finding.name},         {"yaml", finding.yaml},
          {"where", finding.where},       {"holds", finding.holds},
          {"step", finding.step},         {"time_s", base::ToSeconds(finding.time)},
          {"detail", finding.Sentence()}, {"measured", std::move(measured)}};
}

}  // namespace

std::string JsonReport(const simulation::Simulation& simulation,
                       const std::vector<std::string>& warnings,
                       const std::vector<verdict::Finding>& findings) {
  const simulation::SimulationStatus status = simulation.status();
  ordered_json robots = ordered_json::array();
  for (const auto& robot : status.robots) robots.push_back(RobotJson(robot));
  ordered_json expectations = ordered_json::array();
  for (const auto& finding : findings) expectations.push_back(FindingJson(finding));
  const ordered_json report = {{"sim_time_s", Seconds(status.time)},
                               {"wall_time_s", Seconds(status.wall_time)},
                               {"real_time_factor", status.real_time_factor},
                               {"steps", status.step},
                               {"late_steps", status.late_steps},
                               {"state_hash", simulation.state_hash()},
                               {"phase", ToString(status.phase)},
                               {"robots", std::move(robots)},
                               {"warnings", warnings},
                               {"failure", status.failure},
                               {"expectations", std::move(expectations)}};
  // Names from files may contain any bytes, so invalid UTF-8 is replaced.
  return report.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string TextReport(const simulation::Simulation& simulation,
                       const std::vector<verdict::Finding>& findings) {
  const simulation::SimulationStatus status = simulation.status();
  char line[512];
  std::snprintf(line, sizeof line,
                "%s after %.2f s simulated in %.2f s (%.2f x real time), %lld steps, %llu late\n",
                ToString(status.phase), Seconds(status.time), Seconds(status.wall_time),
                status.real_time_factor, static_cast<long long>(status.step),
                static_cast<unsigned long long>(status.late_steps));
  std::string text = line;
  for (const auto& robot : status.robots) {
    std::snprintf(line, sizeof line, "  %-20.64s %-14.64s %-12s %7.2f m  %llu collisions\n",
                  robot.name.c_str(), BehaviourText(robot), ToString(robot.phase), robot.distance,
                  static_cast<unsigned long long>(robot.collisions));
    text += line;
  }
  for (const verdict::Finding& finding : findings) {
    text += (finding.holds ? "  ok    " : "  FAIL  ") + finding.name +
            (finding.holds ? "" : "\n        " + finding.Sentence()) + "\n";
  }
  const std::string hash = simulation.state_hash();
  return hash.empty() ? text : text + "state " + hash + "\n";
}

}  // namespace gsv::app
