#include "apps/gsv/population.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "apps/gsv/in_process.h"

namespace gsv::app {
namespace {

using simulation::RobotSpecification;
using simulation::Simulation;

constexpr int kPlacesTried = 400;

// The nth place of a spiral about the origin, about a metre from its neighbours.
geometry::Pose SpiralPlace(int n) {
  const double turns = std::sqrt(static_cast<double>(n));
  const double angle = turns * std::numbers::pi * 2 / 1.8;
  return geometry::PlanarPose(0.7 * turns * std::cos(angle), 0.7 * turns * std::sin(angle), 0,
                              angle);
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

  base::Status Add() {
    for (const auto& robot : simulation_.status().robots)
      wanted_[robot.name] = BehaviourOf(options_, robot.name, "");
    if (auto ok = PlaceThoseWithAPlace(); !ok) return ok;
    for (const scenario::RobotEntry& robot : options_.scenario.robots) {
      if (robot.start) continue;
      auto name = Place(robot, false);
      if (!name) return base::Fail(name.error());
      wanted_[*name] = BehaviourOf(options_, *name, robot.behaviour);
    }
    for (const scenario::RobotEntry& avatar : options_.avatars) {
      if (auto name = Place(avatar, true); !name) return base::Fail(name.error());
    }
    for (const auto& [robot, movement] : options_.movement_of) {
      if (moved_as_told_.contains(robot)) continue;
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "no robot of that name or model is added by --robot",
                        "--movement " + robot);
    }
    for (const auto& [robot, behaviour] : options_.behaviour_of) {
      if (!wanted_.contains(robot)) {
        return base::Fail(base::ErrorCode::kInvalidArgument, "there is no robot of that name",
                          "--behaviour " + robot + "=" + behaviour);
      }
    }
    return GiveBehaviours();
  }

 private:
  base::Result<RobotSpecification> Specify(const scenario::RobotEntry& entry, bool is_avatar) {
    auto model = runtime_.host().library().ReadModel(entry.model, problems_,
                                                     simulation_.specification().world->source);
    if (!model) return base::Fail(model.error());
    RobotSpecification robot;
    robot.name = entry.name;
    robot.model = *model;
    robot.is_avatar = is_avatar;
    const std::string& name = entry.name.empty() ? (*model)->name : entry.name;
    const auto movement = options_.movement_of.find(name);
    if (movement != options_.movement_of.end()) {
      robot.movement = movement->second;
      moved_as_told_.insert(name);
    }
    if (entry.start) robot.world_from_robot = *entry.start;
    return robot;
  }

  // All at once: a crowd is not put together robot by robot.
  base::Status PlaceThoseWithAPlace() {
    std::vector<RobotSpecification> robots;
    std::vector<std::string> behaviours;
    for (const scenario::RobotEntry& entry : options_.scenario.robots) {
      if (!entry.start) continue;
      auto robot = Specify(entry, false);
      if (!robot) return base::Fail(robot.error());
      robots.push_back(*std::move(robot));
      behaviours.push_back(entry.behaviour);
    }
    const auto names = simulation_.AddRobots(std::move(robots));
    if (!names) return base::Fail(names.error());
    for (std::size_t i = 0; i < names->size(); ++i) {
      wanted_[(*names)[i]] = BehaviourOf(options_, (*names)[i], behaviours[i]);
    }
    return {};
  }

  base::Result<std::string> Place(const scenario::RobotEntry& entry, bool is_avatar) {
    auto robot = Specify(entry, is_avatar);
    if (!robot) return base::Fail(robot.error());
    if (entry.start) return simulation_.AddRobot(*std::move(robot));
    base::Result<std::string> name;
    for (int n = 0; n < kPlacesTried; ++n) {
      robot->world_from_robot = SpiralPlace(n);
      name = simulation_.AddRobot(*robot);
      if (name) break;
    }
    return name;
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
  std::map<std::string, std::string> wanted_;  // behaviour by robot
  std::set<std::string> moved_as_told_;        // of options_.movement_of
};

}  // namespace

base::Status Populate(Runtime& runtime, Simulation& simulation, const RunOptions& options,
                      base::Problems& problems) {
  return Population(runtime, simulation, options, problems).Add();
}

}  // namespace gsv::app
