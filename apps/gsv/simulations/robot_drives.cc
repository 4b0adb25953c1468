#include "apps/gsv/simulations/robot_drives.h"

#include <algorithm>
#include <set>

#include "gsv/model/drive_choice.h"

namespace gsv::app {
namespace {

using model::WorldDescription;

const model::PlacedModel* PlacedNamed(const WorldDescription& world, const std::string& name) {
  const auto found = std::find_if(world.models.begin(), world.models.end(),
                                  [&](const auto& placed) { return placed.name == name; });
  return found == world.models.end() ? nullptr : &*found;
}

}  // namespace

base::Result<std::shared_ptr<const WorldDescription>> WithDrives(
    std::shared_ptr<const WorldDescription> world, const scenario::Scenario& scenario) {
  std::shared_ptr<WorldDescription> changed;
  for (const scenario::RobotEntry& robot : scenario.robots) {
    if (!robot.model.empty()) continue;
    const model::PlacedModel* const placed = PlacedNamed(*world, robot.name);
    if (placed == nullptr || placed->is_static || placed->model->is_static) continue;
    if (placed->model->drive && robot.drive.empty()) continue;
    auto model = model::AsRobot(placed->model, robot.drive);
    // If no drive can be guessed, the model stays without one. Populate() refuses the entry later,
    // unless it names a station (world/station.h).
    if (!model && robot.drive.empty()) continue;
    if (!model) return base::Fail(model.error());
    if (changed == nullptr) changed = std::make_shared<WorldDescription>(*world);
    changed->models[static_cast<std::size_t>(placed - world->models.data())].model =
        *std::move(model);
  }
  if (changed == nullptr) return world;
  return std::shared_ptr<const WorldDescription>(std::move(changed));
}

base::Result<std::map<std::string, std::string>> ParseDrives(
    const std::vector<std::string>& texts) {
  std::map<std::string, std::string> drives;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "expected ROBOT=KIND[,KEY=VALUE]..., such as husky=skid,radius=0.16",
                        "--drive " + text);
    }
    const std::string drive = text.substr(equals + 1);
    if (const auto choice = model::ParseDriveChoice(drive); !choice) {
      return base::Fail(base::ErrorCode::kInvalidArgument, choice.error().message,
                        "--drive " + text);
    }
    drives[text.substr(0, equals)] = drive;
  }
  return drives;
}

std::vector<std::string> DriveNotes(const simulation::Simulation& simulation) {
  std::vector<std::string> notes;
  std::set<const model::Model*> described;
  for (const world::Body& body : simulation.snapshot()->layout->bodies) {
    const bool is_new = body.is_robot() && !body.is_avatar() && body.model->drive &&
                        body.model->drive->origin != model::DriveOrigin::kPlugin &&
                        described.insert(body.model.get()).second;
    if (!is_new) continue;
    const bool is_guessed = body.model->drive->origin == model::DriveOrigin::kGuessed;
    notes.push_back(body.name + ": drive: " + model::DescribeDrive(*body.model) +
                    (is_guessed ? "; override with --drive" : ""));
  }
  return notes;
}

}  // namespace gsv::app
