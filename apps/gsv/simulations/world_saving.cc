#include "apps/gsv/simulations/world_saving.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "gsv/formats/world_writer.h"
#include "gsv/recording/attachments/scenario_attachment.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::app {
namespace {

using model::PlacedModel;

struct Standing {
  std::vector<PlacedModel> models;
  std::map<std::string, geometry::Pose> poses;  // poses of all bodies
  std::set<std::string> saved;                  // names of `models`
};

const PlacedModel* FindOriginal(const model::WorldDescription& world, const std::string& name) {
  const auto found = std::find_if(world.models.begin(), world.models.end(),
                                  [&](const PlacedModel& placed) { return placed.name == name; });
  return found == world.models.end() ? nullptr : &*found;
}

// Whether the saved world file can express how the body moves. It always can if `is_original`: the
// body comes from the simulation's world file, and the saved file takes its movement from there.
bool FitsInWorld(const world::Body& body, const PlacedModel& placed, bool is_original) {
  if (body.is_avatar()) return false;
  if (is_original) return true;
  const bool has_chosen_drive = body.model->drive && !body.model->drive->choice.empty();
  return !has_chosen_drive && world::KindOf(placed) == body.kind;
}

Standing StandingNow(const world::Snapshot& snapshot, const model::WorldDescription& original) {
  Standing standing;
  const auto& bodies = snapshot.layout->bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const world::Body& body = bodies[i];
    const geometry::Pose& pose = snapshot.state.bodies[i].world_from_model;
    standing.poses[body.name] = pose;
    // Pedestrians are not saved as models, because the scenario or the world file has their groups.
    if (body.is_pedestrian()) continue;
    const PlacedModel placed{body.name, body.model, pose, body.is_static()};
    if (!FitsInWorld(body, placed, FindOriginal(original, body.name) != nullptr)) continue;
    standing.models.push_back(placed);
    standing.saved.insert(body.name);
  }
  return standing;
}

// Removes model, pose and movement from the entries of robots that the saved world file contains.
// Removes such an entry completely if it has no behaviour and no drive. Other entries get the
// robot's current pose.
void TakeSavedRobots(const Standing& standing, std::vector<scenario::RobotEntry>& robots,
                     std::vector<std::string>& warnings) {
  for (scenario::RobotEntry& robot : robots) {
    if (!standing.saved.contains(robot.name)) {
      const auto pose = standing.poses.find(robot.name);
      if (pose != standing.poses.end()) {
        const auto& [p, q] = pose->second;
        robot.start = scenario::Place{p.x, p.y, p.z, geometry::Yaw(q)};
      }
      warnings.push_back(
          robot.name +
          " is saved in the scenario only, because a world file cannot contain its movement");
      continue;
    }
    robot.model.clear();
    robot.start.reset();
    robot.movement.reset();
  }
  std::erase_if(robots, [&](const scenario::RobotEntry& robot) {
    return standing.saved.contains(robot.name) && robot.behaviour.empty() && robot.drive.empty();
  });
}

}  // namespace

base::Result<gateway::SimulationFactory::SavedWorld> SaveWorld(
    const simulation::Simulation& simulation, const std::string& file,
    const formats::ReadOptions& options) {
  const std::shared_ptr<const world::Snapshot> snapshot = simulation.snapshot();
  const model::WorldDescription& original = *simulation.specification().world;
  const Standing standing = StandingNow(*snapshot, original);
  base::Problems problems;
  auto sdf = formats::WriteWorld(original, standing.models, snapshot->layout->description->gravity,
                                 options, problems);
  if (!sdf) return base::Fail(sdf.error());
  gateway::SimulationFactory::SavedWorld saved;
  saved.sdf = *std::move(sdf);
  for (const base::Problem& problem : problems) saved.warnings.push_back(problem.Sentence());
  scenario::Scenario scenario = recording::ScenarioOf(simulation);
  scenario.world = file;
  TakeSavedRobots(standing, scenario.robots, saved.warnings);
  TakeSavedRobots(standing, scenario.avatars, saved.warnings);
  saved.scenario = scenario::ToYaml(scenario);
  return saved;
}

}  // namespace gsv::app
