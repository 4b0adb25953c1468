#include "apps/gsv/population.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "apps/gsv/in_process.h"
#include "gsv/recording/scenario_attachment.h"

namespace gsv::app {
namespace {

using simulation::RobotSpecification;
using simulation::Simulation;

constexpr int kPlacesTried = 400;

// The nth place of a spiral about the origin, about a metre from its neighbours.
scenario::Place SpiralPlace(int n) {
  const double turns = std::sqrt(static_cast<double>(n));
  const double angle = turns * std::numbers::pi * 2 / 1.8;
  return {0.7 * turns * std::cos(angle), 0.7 * turns * std::sin(angle), {}, angle};
}

void Stand(const scenario::Place& place, RobotSpecification& robot) {
  robot.world_from_robot = place.pose();
  robot.on_ground = !place.z;
}

// What is there under this name stays what it is from another folder.
std::string Whole(const std::string& name) {
  std::error_code ignored;
  if (name.empty() || !std::filesystem::exists(name, ignored)) return name;
  return std::filesystem::absolute(name, ignored).lexically_normal().string();
}

// The behaviour a robot is to have: its own on the command line, its scenario's, that of all.
std::string BehaviourOf(const RunOptions& options, const std::string& robot,
                        const std::string& of_scenario) {
  const auto it = options.behaviour_of.find(robot);
  if (it != options.behaviour_of.end()) return it->second;
  if (!options.behaviour.empty()) return options.behaviour;
  return of_scenario;
}

class Population {
 public:
  Population(Runtime& runtime, Simulation& simulation, const RunOptions& options,
             base::Problems& problems)
      : runtime_(runtime), simulation_(simulation), options_(options), problems_(problems) {}

  base::Result<scenario::Scenario> Add() {
    for (const auto& robot : simulation_.status().robots)
      wanted_[robot.name] = BehaviourOf(options_, robot.name, "");
    if (auto ok = TakeThoseOfTheWorld(); !ok) return base::Fail(ok.error());
    const std::map<std::string, std::string> of_world = wanted_;
    if (auto ok = PlaceThoseWithAPlace(); !ok) return base::Fail(ok.error());
    for (const scenario::RobotEntry& robot : options_.scenario.robots) {
      if (robot.start || robot.model.empty()) continue;
      if (auto ok = Place(robot, false); !ok) return base::Fail(ok.error());
    }
    for (const scenario::RobotEntry& avatar : options_.scenario.avatars) {
      if (auto ok = Place(avatar, true); !ok) return base::Fail(ok.error());
    }
    if (auto ok = RefuseUnknownNames(); !ok) return base::Fail(ok.error());
    if (auto ok = GiveBehaviours(); !ok) return base::Fail(ok.error());
    return Told(of_world);
  }

 private:
  base::Status TakeThoseOfTheWorld() {
    for (const scenario::RobotEntry& robot : options_.scenario.robots) {
      if (!robot.model.empty()) continue;
      if (!wanted_.contains(robot.name)) {
        return base::Fail(base::ErrorCode::kInvalidArgument,
                          "the world brings no robot of that name; one that is added needs a model",
                          robot.name);
      }
      wanted_[robot.name] = BehaviourOf(options_, robot.name, robot.behaviour);
    }
    return {};
  }

  base::Status RefuseUnknownNames() const {
    for (const auto& [robot, movement] : options_.movement_of) {
      if (moved_as_told_.contains(robot)) continue;
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "no robot of that name or model is added", "--movement " + robot);
    }
    for (const auto& [robot, behaviour] : options_.behaviour_of) {
      if (wanted_.contains(robot)) continue;
      return base::Fail(base::ErrorCode::kInvalidArgument, "there is no robot of that name",
                        "--behaviour " + robot + "=" + behaviour);
    }
    return {};
  }

  base::Result<RobotSpecification> Specify(const scenario::RobotEntry& entry, bool is_avatar) {
    auto model = runtime_.host().library().ReadModel(entry.model, problems_,
                                                     simulation_.specification().world->source);
    if (!model) return base::Fail(model.error());
    RobotSpecification robot;
    robot.name = entry.name;
    robot.model = *model;
    robot.is_avatar = is_avatar;
    robot.movement = entry.movement;
    const std::string& name = entry.name.empty() ? (*model)->name : entry.name;
    const auto movement = options_.movement_of.find(name);
    if (movement != options_.movement_of.end()) {
      robot.movement = movement->second;
      moved_as_told_.insert(name);
    }
    if (entry.start) Stand(*entry.start, robot);
    return robot;
  }

  // All at once: a crowd is not put together robot by robot.
  base::Status PlaceThoseWithAPlace() {
    std::vector<RobotSpecification> robots;
    std::vector<scenario::RobotEntry> entries;
    for (const scenario::RobotEntry& entry : options_.scenario.robots) {
      if (!entry.start || entry.model.empty()) continue;
      auto robot = Specify(entry, false);
      if (!robot) return base::Fail(robot.error());
      entries.push_back(entry);
      entries.back().movement = robot->movement;
      robots.push_back(*std::move(robot));
    }
    const auto names = simulation_.AddRobots(std::move(robots));
    if (!names) return base::Fail(names.error());
    for (std::size_t i = 0; i < names->size(); ++i) {
      entries[i].name = (*names)[i];
      wanted_[entries[i].name] = BehaviourOf(options_, entries[i].name, entries[i].behaviour);
      robots_.push_back(std::move(entries[i]));
    }
    return {};
  }

  base::Status Place(scenario::RobotEntry entry, bool is_avatar) {
    auto robot = Specify(entry, is_avatar);
    if (!robot) return base::Fail(robot.error());
    entry.movement = robot->movement;
    if (entry.start) {
      auto name = simulation_.AddRobot(*std::move(robot));
      if (!name) return base::Fail(name.error());
      entry.name = *std::move(name);
    } else {
      auto placed = AddAtFreePlace(simulation_, *std::move(robot));
      if (!placed) return base::Fail(placed.error());
      entry.name = std::move(placed->name);
      entry.start = placed->place;
    }
    if (!is_avatar) wanted_[entry.name] = BehaviourOf(options_, entry.name, entry.behaviour);
    (is_avatar ? avatars_ : robots_).push_back(std::move(entry));
    return {};
  }

  // The scenario as it came to be.
  scenario::Scenario Told(const std::map<std::string, std::string>& of_world) const {
    scenario::Scenario told = recording::ScenarioOf(simulation_);
    const scenario::Scenario& given = options_.scenario;
    told.world = Whole(given.world);
    told.in_process = options_.in_process;
    for (const std::string& path : given.model_path) told.model_path.push_back(Whole(path));
    told.robots = robots_;
    told.avatars = avatars_;
    for (const auto& [robot, behaviour] : of_world) {
      if (!behaviour.empty()) told.robots.push_back({.name = robot});
    }
    for (scenario::RobotEntry& robot : told.robots) robot.behaviour = wanted_.at(robot.name);
    for (auto* entries : {&told.robots, &told.avatars}) {
      for (scenario::RobotEntry& entry : *entries) entry.model = Whole(entry.model);
    }
    told.record_topics = given.record_topics;
    const RecordingChoice& choice = options_.recording;
    told.record_rates = {{"poses", choice.poses_rate},
                         {"readings", choice.readings_rate},
                         {"pictures", choice.pictures_rate},
                         {"beams", choice.beams_rate}};
    told.record_png = given.record_png;
    return told;
  }

  base::Status GiveBehaviours() {
    if (options_.in_process || options_.make_behaviour) return HostBehaviours();
    std::map<std::string, int> programs;
    for (const auto& [robot, behaviour] : wanted_) {
      if (!behaviour.empty()) ++programs[behaviour];
    }
    for (const auto& [behaviour, count] : programs) {
      if (auto ok = runtime_.launcher().Ensure(behaviour, count); !ok) return ok;
    }
    for (const auto& [robot, behaviour] : wanted_) {
      if (behaviour.empty()) continue;
      auto port = runtime_.behaviours().Get(services::ConstraintForName(behaviour));
      if (!port) return base::Fail(port.error());
      if (auto ok = simulation_.SetBehaviour(robot, *std::move(port)); !ok) return ok;
    }
    return {};
  }

  base::Status HostBehaviours() {
    for (const auto& [robot, behaviour] : wanted_) {
      if (behaviour.empty()) continue;
      auto port = options_.make_behaviour ? options_.make_behaviour(robot, behaviour)
                                          : InProcessBehaviour(behaviour);
      if (!port) return base::Fail(port.error());
      if (auto ok = simulation_.SetBehaviour(robot, *std::move(port)); !ok) return ok;
    }
    return {};
  }

  Runtime& runtime_;
  Simulation& simulation_;
  const RunOptions& options_;
  base::Problems& problems_;
  std::map<std::string, std::string> wanted_;           // behaviour by robot
  std::set<std::string> moved_as_told_;                 // of options_.movement_of
  std::vector<scenario::RobotEntry> robots_, avatars_;  // that were added, as they stand
};

}  // namespace

base::Result<PlacedRobot> AddAtFreePlace(Simulation& simulation, RobotSpecification robot) {
  base::Error refusal;
  for (int n = 0; n < kPlacesTried; ++n) {
    const scenario::Place place = SpiralPlace(n);
    Stand(place, robot);
    auto name = simulation.AddRobot(robot);
    if (name) return PlacedRobot{*std::move(name), place};
    refusal = name.error();
  }
  return base::Fail(refusal);
}

base::Result<scenario::Scenario> Populate(Runtime& runtime, Simulation& simulation,
                                          const RunOptions& options, base::Problems& problems) {
  return Population(runtime, simulation, options, problems).Add();
}

}  // namespace gsv::app
