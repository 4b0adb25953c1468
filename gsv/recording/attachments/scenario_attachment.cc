#include "gsv/recording/attachments/scenario_attachment.h"

#include <algorithm>
#include <map>
#include <set>

namespace gsv::recording {
namespace {

using simulation::Simulation;

scenario::Place PlaceOf(const geometry::Pose& pose) {
  return {pose.position.x, pose.position.y, pose.position.z, geometry::Yaw(pose.orientation)};
}

// Returns a time in seconds. The function divides, because multiplying by 1e-9 would give
// 1.9900000000000002 for 1.99 s.
double ShortSeconds(std::chrono::nanoseconds time) {
  return static_cast<double>(time.count()) / 1e9;
}

bool CameWithTheWorld(const model::WorldDescription& world, const std::string& body) {
  return std::any_of(world.models.begin(), world.models.end(),
                     [&](const model::PlacedModel& placed) { return placed.name == body; });
}

bool HasChosenDrive(const world::Body& body) {
  return body.model->drive && !body.model->drive->choice.empty();
}

}  // namespace

scenario::Scenario ScenarioOf(const Simulation& simulation) {
  const simulation::Specification& specification = simulation.specification();
  scenario::Scenario scenario;
  scenario.world =
      specification.world->source.empty() ? specification.world->name : specification.world->source;
  scenario.name = specification.name;
  scenario.seed = specification.seed;
  scenario.lockstep = specification.mode == simulation::Mode::kLockstep;
  scenario.factor = specification.factor;
  scenario.step = ShortSeconds(specification.step);
  scenario.duration = ShortSeconds(specification.duration);
  scenario.deadline = ShortSeconds(specification.deadline);
  if (specification.stuck_after != simulation::Specification().stuck_after) {
    scenario.stuck_after = ShortSeconds(specification.stuck_after);
  }
  scenario.faults = specification.faults;
  scenario.pedestrians = specification.pedestrians;
  scenario.fails_with_behaviour = specification.on_failure == simulation::FailurePolicy::kFail;

  // The name of each robot's behaviour.
  std::map<std::string, std::string> behaviours;
  for (const auto& robot : simulation.status().robots) behaviours[robot.name] = robot.behaviour;
  for (const world::Body& body : simulation.snapshot()->layout->bodies) {
    if (!body.is_robot()) continue;
    scenario::RobotEntry entry;
    entry.name = body.name;
    entry.behaviour = behaviours[body.name];
    if (!CameWithTheWorld(*specification.world, body.name)) {
      entry.model = body.model->source.empty() ? body.model->name : body.model->source;
      entry.start = PlaceOf(body.initial_pose);
    } else if (entry.behaviour.empty() && !HasChosenDrive(body)) {
      continue;
    }
    const bool is_told = !entry.model.empty() && !body.is_avatar();
    if (is_told && body.is_rigid() != (body.model->movement == model::Movement::kRigid)) {
      entry.movement = body.is_rigid() ? model::Movement::kRigid : model::Movement::kPlanar;
    }
    if (body.model->drive) entry.drive = body.model->drive->choice;
    (body.is_avatar() ? scenario.avatars : scenario.robots).push_back(std::move(entry));
  }
  return scenario;
}

std::vector<simulation::Edit> EditsBeforeStart(const Simulation& simulation) {
  if (simulation.status().phase != simulation::Phase::kCreated) return {};
  const model::WorldDescription& world = *simulation.specification().world;
  // Names of the scenario's robots, including robots that were removed.
  std::set<std::string> of_scenario;
  std::vector<simulation::Edit> edits;
  for (const simulation::Event& event : simulation.events(0)) {
    if (event.kind == "reset") edits.clear();
    if (event.edit == nullptr) continue;
    const simulation::Edit& edit = *event.edit;
    const bool adds_robot = edit.kind == simulation::Edit::Kind::kAddRobot ||
                            edit.kind == simulation::Edit::Kind::kAddAvatar;
    if (adds_robot && !CameWithTheWorld(world, edit.body)) of_scenario.insert(edit.body);
    if (!of_scenario.contains(edit.body)) edits.push_back(edit);
  }
  return edits;
}

}  // namespace gsv::recording
