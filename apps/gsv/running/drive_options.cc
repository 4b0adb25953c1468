#include "apps/gsv/running/drive_options.h"

#include <algorithm>
#include <set>

#include "apps/gsv/simulations/robot_drives.h"
#include "gsv/base/spelling.h"

namespace gsv::app {
namespace {

using model::WorldDescription;

// Returns the names that --drive accepts: the names of the scenario's robots and of the world's
// models.
std::vector<std::string> DriveNames(const WorldDescription& world,
                                    const scenario::Scenario& scenario) {
  std::vector<std::string> names;
  for (const scenario::RobotEntry& robot : scenario.robots) {
    names.push_back(robot.name.empty() ? robot.model : robot.name);
  }
  for (const model::PlacedModel& placed : world.models) names.push_back(placed.name);
  return names;
}

bool HasModel(const WorldDescription& world, const std::string& name) {
  return std::any_of(world.models.begin(), world.models.end(),
                     [&](const model::PlacedModel& placed) { return placed.name == name; });
}

// Returns the name that a robot will have when it is added. (If the name is used already, the robot
// will have another name.)
base::Result<std::string> NameOf(const scenario::RobotEntry& robot, const std::string& world,
                                 formats::ModelLibrary& library, base::Problems& problems) {
  if (!robot.name.empty() || robot.model.empty()) return robot.name;
  const auto model = library.ReadModel(robot.model, problems, world);
  if (!model) return base::Fail(model.error());
  return (*model)->name;
}

// Sets the drives of the scenario's robots. Returns the names in --drive that belong to none of
// these robots.
base::Result<std::set<std::string>> OverrideDrives(const std::string& world,
                                                   formats::ModelLibrary& library,
                                                   RunOptions& options, base::Problems& problems) {
  std::set<std::string> left;
  for (const auto& [robot, drive] : options.drive_of) left.insert(robot);
  if (left.empty()) return left;
  for (scenario::RobotEntry& robot : options.scenario.robots) {
    const auto name = NameOf(robot, world, library, problems);
    if (!name) return base::Fail(name.error());
    const auto drive = options.drive_of.find(*name);
    if (drive == options.drive_of.end()) continue;
    robot.drive = drive->second;
    left.erase(*name);
  }
  return left;
}

}  // namespace

base::Status PrepareDrives(const std::string& file, formats::ModelLibrary& library,
                           RunOptions& options, base::Problems& problems) {
  base::Problems again;  // these problems are reported when the robots are added
  const auto left = OverrideDrives(file, library, options, again);
  if (!left) return base::Fail(left.error());
  scenario::Scenario wanted = options.scenario;
  for (const auto& [robot, behaviour] : options.behaviour_of) {
    wanted.robots.push_back({.name = robot});
  }
  const bool names_any =
      !left->empty() || std::any_of(wanted.robots.begin(), wanted.robots.end(),
                                    [](const auto& robot) { return robot.model.empty(); });
  if (!names_any) return {};
  auto& world = options.specification.world;
  if (world == nullptr) {
    auto read = library.ReadWorld(file, problems);
    if (!read) return base::Fail(read.error());
    world = std::make_shared<const WorldDescription>(*std::move(read));
  }
  for (const std::string& name : *left) {
    if (!HasModel(*world, name)) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "there is no robot of this name or model; check --robot and the world" +
                            base::DidYouMean(name, DriveNames(*world, options.scenario)),
                        "--drive " + name);
    }
    const scenario::RobotEntry entry{.name = name, .drive = options.drive_of.at(name)};
    options.scenario.robots.push_back(entry);
    wanted.robots.push_back(entry);
  }
  auto changed = WithDrives(world, wanted);
  if (!changed) return base::Fail(changed.error());
  world = *std::move(changed);
  return {};
}

}  // namespace gsv::app
