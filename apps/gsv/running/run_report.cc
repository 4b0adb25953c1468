#include "apps/gsv/running/run_report.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include <nlohmann/json.hpp>

#include "gsv/base/counted.h"
#include "gsv/base/sorting.h"
#include "gsv/health/health_tracker.h"

namespace gsv::app {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kCrowd =
    20;  // more robots than this are sorted by the severity of their state

const char* BehaviourText(const simulation::RobotStatus& robot) {
  if (!robot.behaviour.empty()) return robot.behaviour.c_str();
  return robot.is_station ? "(station)" : "-";
}

const char* OutcomeText(simulation::Phase phase) {
  using simulation::Phase;
  switch (phase) {
    case Phase::kFinished:
      return "Finished";
    case Phase::kFailed:
      return "Failed";
    case Phase::kStopped:
      return "Stopped";
    default:
      return ToString(phase);
  }
}

const health::RobotHealth* HealthIn(const health::Report& report, const std::string& robot) {
  const auto found = std::find_if(report.robots.begin(), report.robots.end(),
                                  [&](const auto& each) { return each.robot == robot; });
  return found == report.robots.end() ? nullptr : &*found;
}

// Returns one line per robot. If there are more than kCrowd robots, those with the most serious
// states come first.
std::string RobotLines(const simulation::SimulationStatus& status, const health::Report& report) {
  struct RobotLine {
    const simulation::RobotStatus* robot;
    const health::RobotHealth* health;  // null for a station
    int Trouble() const {
      return health == nullptr ? 0 : health::Severity(health->state, health->level);
    }
  };
  std::vector<RobotLine> rows;
  int name_width = 20, behaviour_width = 14;
  for (const simulation::RobotStatus& robot : status.robots) {
    rows.push_back({&robot, HealthIn(report, robot.name)});
    name_width = std::max(name_width, static_cast<int>(robot.name.size()));
    behaviour_width =
        std::max(behaviour_width, static_cast<int>(std::strlen(BehaviourText(robot))));
  }
  name_width = std::min(name_width, 40);
  behaviour_width = std::min(behaviour_width, 40);
  if (rows.size() > kCrowd) {
    base::Sort(rows,
               [](const RobotLine& a, const RobotLine& b) { return a.Trouble() > b.Trouble(); });
  }
  std::string text;
  char line[512];
  for (const auto& [robot, health] : rows) {
    std::snprintf(line, sizeof line, "  %-*.64s %-*.64s %-12s %7.2f m  ", name_width,
                  robot->name.c_str(), behaviour_width, BehaviourText(*robot),
                  ToString(robot->phase), robot->distance);
    text += line + base::Counted(robot->collisions, "collision");
    const std::string sentence = health == nullptr ? "" : health::FinalSentence(*health);
    text += (sentence.empty() ? "" : "; " + sentence) + "\n";
  }
  return text;
}

ordered_json RobotJson(const simulation::RobotStatus& robot, const health::Report& report) {
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
  if (const health::RobotHealth* health = HealthIn(report, robot.name)) {
    json["health"] = {{"state", health::ToString(health->state)},
                      {"level", static_cast<int>(health->level)},
                      {"since_s", base::ToSeconds(health->since)},
                      {"sentence", health::FinalSentence(*health)}};
  }
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

std::string JsonReport(simulation::Simulation& simulation, const std::vector<std::string>& warnings,
                       const std::vector<verdict::Finding>& findings) {
  const simulation::SimulationStatus status = simulation.status();
  ordered_json robots = ordered_json::array();
  const health::Report health = health::HealthNow(simulation);
  for (const auto& robot : status.robots) robots.push_back(RobotJson(robot, health));
  ordered_json expectations = ordered_json::array();
  for (const auto& finding : findings) expectations.push_back(FindingJson(finding));
  const ordered_json report = {{"sim_time_s", base::ToSeconds(status.time)},
                               {"wall_time_s", base::ToSeconds(status.wall_time)},
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

std::string TextReport(simulation::Simulation& simulation,
                       const std::vector<verdict::Finding>& findings) {
  const simulation::SimulationStatus status = simulation.status();
  char line[512];
  std::snprintf(line, sizeof line,
                "%s after %.2f s simulated in %.2f s (%.2f x real time), %lld steps, %llu late\n",
                OutcomeText(status.phase), base::ToSeconds(status.time),
                base::ToSeconds(status.wall_time), status.real_time_factor,
                static_cast<long long>(status.step),
                static_cast<unsigned long long>(status.late_steps));
  std::string text = line;
  const health::Report report = health::HealthNow(simulation);
  if (report.robots.size() > 1) text += "  " + health::Summary(report) + "\n";
  text += RobotLines(status, report);
  for (const verdict::Finding& finding : findings) {
    text += (finding.holds ? "  ok    " : "  FAIL  ") + finding.name +
            (finding.holds ? "" : "\n        " + finding.Sentence()) + "\n";
  }
  const std::string hash = simulation.state_hash();
  return hash.empty() ? text : text + "state " + hash + "\n";
}

}  // namespace gsv::app
