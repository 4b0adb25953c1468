#include "apps/gsv/commands/robot_listing.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "gsv/base/counted.h"
#include "gsv/base/sorting.h"
#include "gsv/health/health.h"

namespace gsv::app {
namespace {

struct RobotRow {
  const simulation::RobotStatus* robot;
  const RemoteHealth* health;  // null if the server does not report it
  health::State state = health::State::kMoving;
  int severity = 0;
};

// Returns the robot's state. If the server does not report the robot's health, derives the state
// from the state of the behaviour.
health::State StateOf(const RobotRow& row) {
  if (row.health != nullptr) {
    return health::StateOf(row.health->state).value_or(health::State::kMoving);
  }
  switch (row.robot->phase) {
    case simulation::AgentPhase::kDead:
      return health::State::kDead;
    case simulation::AgentPhase::kUnresponsive:
      return health::State::kLate;
    default:
      return health::State::kMoving;
  }
}

std::vector<RobotRow> RowsOf(const simulation::SimulationStatus& status,
                             const std::map<std::string, RemoteHealth>& healths) {
  std::vector<RobotRow> rows;
  for (const simulation::RobotStatus& robot : status.robots) {
    const auto found = healths.find(robot.name);
    RobotRow& row =
        rows.emplace_back(RobotRow{&robot, found == healths.end() ? nullptr : &found->second});
    row.state = StateOf(row);
    const int level = row.health == nullptr ? 0 : row.health->level;
    row.severity = health::Severity(row.state, static_cast<health::Level>(level));
  }
  return rows;
}

std::string LineOf(const RobotRow& row, std::size_t name_width) {
  const simulation::RobotStatus& robot = *row.robot;
  const std::string text = row.health == nullptr ? (robot.detail.empty() ? "" : ": " + robot.detail)
                                                 : "; the robot " + row.health->sentence;
  return fmt::format("  {:{}} {:16} {}{}\n", robot.name, name_width,
                     robot.behaviour.empty() ? "-" : robot.behaviour, ToString(robot.phase), text);
}

// Returns a line such as "  and 30 more robots: 29 move, 1 stands (--all lists them)".
std::string RestOf(const std::vector<RobotRow>& rows, std::size_t listed) {
  health::Report rest;
  bool is_reported = false;
  for (std::size_t i = listed; i < rows.size(); ++i) {
    if (rows[i].health == nullptr) continue;
    is_reported = true;
    ++rest.counts[static_cast<std::size_t>(rows[i].state)];
  }
  return fmt::format("  and {}{}{} (--all lists them)\n",
                     base::Counted(rows.size() - listed, "more robot"), is_reported ? ": " : "",
                     health::Summary(rest));
}

}  // namespace

std::string RobotListing(const simulation::SimulationStatus& status,
                         const std::map<std::string, RemoteHealth>& healths, bool lists_all) {
  std::vector<RobotRow> rows = RowsOf(status, healths);
  const bool is_crowd = rows.size() > kMaxListed;
  if (is_crowd) {
    base::Sort(rows, [](const RobotRow& a, const RobotRow& b) { return a.severity > b.severity; });
  }
  const std::size_t listed = lists_all ? rows.size() : std::min(rows.size(), kMaxListed);
  std::size_t name_width = 20;
  for (std::size_t i = 0; i < listed; ++i) {
    name_width = std::max(name_width, std::min<std::size_t>(rows[i].robot->name.size(), 40));
  }
  std::string text;
  for (std::size_t i = 0; i < listed; ++i) text += LineOf(rows[i], name_width);
  if (listed < rows.size()) text += RestOf(rows, listed);
  return text;
}

}  // namespace gsv::app
