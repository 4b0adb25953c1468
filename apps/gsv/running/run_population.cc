#include "apps/gsv/running/run_population.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "apps/gsv/running/start_checks.h"
#include "apps/gsv/simulations/in_process.h"
#include "apps/gsv/simulations/population.h"
#include "gsv/base/spelling.h"
#include "gsv/formats/xacro/arguments.h"
#include "gsv/recording/attachments/scenario_attachment.h"

namespace gsv::app {
namespace {

using simulation::Simulation;

// Returns the absolute path if a file with this name exists, else the name as given.
std::string AbsoluteIfExists(const std::string& name) {
  std::error_code ignored;
  const std::string file = formats::xacro::FilePart(name);
  if (name.empty() || !std::filesystem::exists(file, ignored)) return name;
  return std::filesystem::absolute(file, ignored).lexically_normal().string() +
         name.substr(file.size());
}

// Applies --movement, which overrides the scenario.
base::Status OverrideMovements(const RunOptions& options, const Simulation& simulation,
                               formats::ModelLibrary& library, base::Problems& problems,
                               scenario::Scenario& scenario) {
  std::set<std::string> left;
  for (const auto& [robot, movement] : options.movement_of) left.insert(robot);
  if (left.empty()) return {};
  for (scenario::RobotEntry& robot : scenario.robots) {
    std::string name = robot.name;
    if (robot.model.empty()) continue;
    if (name.empty()) {
      const auto model =
          library.ReadModel(robot.model, problems, simulation.specification().world->source);
      if (!model) return base::Fail(model.error());
      name = (*model)->name;
    }
    const auto movement = options.movement_of.find(name);
    if (movement == options.movement_of.end()) continue;
    robot.movement = movement->second;
    left.erase(name);
  }
  if (left.empty()) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument, "no robot of this name or model was added",
                    "--movement " + *left.begin());
}

// Sets the behaviour of each robot. A behaviour for this robot on the command line has precedence,
// then the behaviour for all robots, then the behaviour in the scenario.
base::Status OverrideBehaviours(const RunOptions& options, std::vector<PlacedRobot>& robots) {
  std::set<std::string> names;
  for (PlacedRobot& robot : robots) {
    names.insert(robot.entry.name);
    const auto own = options.behaviour_of.find(robot.entry.name);
    if (own == options.behaviour_of.end() && options.behaviour.empty()) continue;
    robot.entry.behaviour = own != options.behaviour_of.end() ? own->second : options.behaviour;
    robot.entry.behaviour_constraint.clear();
  }
  for (const auto& [robot, behaviour] : options.behaviour_of) {
    if (names.contains(robot)) continue;
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "there is no robot of that name" + base::DidYouMean(robot, {names.begin(), names.end()}),
        "--behaviour " + robot + "=" + behaviour);
  }
  return {};
}

// Checks that --ros2-namespace names robots of the simulation or of an edit.
base::Status CheckNamespaces(const RunOptions& options, const Simulation& simulation) {
  if (!options.runtime.ros2) return {};
  std::vector<std::string> names;
  for (const auto& robot : simulation.status().robots) names.push_back(robot.name);
  for (const simulation::Edit& edit : options.edits) names.push_back(edit.body);
  for (const auto& [robot, name_space] : options.runtime.ros2->namespaces) {
    if (std::find(names.begin(), names.end(), robot) != names.end()) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "there is no robot of that name" + base::DidYouMean(robot, names),
                      "--ros2-namespace " + robot + "=" + name_space);
  }
  return {};
}

// Adds the robots of the world file (`of_world`) to `robots` if they are not in it yet, because
// --behaviour also applies to these robots.
void AddRobotsOfTheWorld(const Simulation& simulation, std::vector<PlacedRobot>& robots,
                         const std::vector<std::string>& of_world) {
  for (const std::string& name : of_world) {
    const bool is_told = std::any_of(robots.begin(), robots.end(), [&](const PlacedRobot& robot) {
      return robot.entry.name == name;
    });
    if (!is_told && simulation.agent(name) != nullptr) robots.push_back({{.name = name}, 0});
  }
}

class RunBehaviours {
 public:
  // `from` is the time at which the robots are added.
  RunBehaviours(Runtime& runtime, const RunOptions& options, base::SimTime from = {})
      : runtime_(runtime), options_(options), from_(from) {}

  // Starts a program for each behaviour that the broker does not offer.
  base::Status Ensure(const std::vector<PlacedRobot>& robots) {
    if (options_.in_process || options_.make_behaviour) return {};
    std::map<std::string, int> programs;
    for (const PlacedRobot& robot : robots) {
      if (robot.entry.behaviour.empty() || robot.entry.behaviour == kRos2Behaviour) continue;
      ++programs[robot.entry.behaviour];
    }
    for (const auto& [behaviour, count] : programs) {
      if (auto ok = runtime_.launcher().Ensure(behaviour, count); !ok) return ok;
    }
    return {};
  }

  FieldResult<std::shared_ptr<simulation::BehaviourPort>> Make(const scenario::RobotEntry& robot) {
    if (robot.behaviour.empty() && robot.behaviour_constraint.empty()) return nullptr;
    if (robot.behaviour == kRos2Behaviour) {
      const auto& ros2 = options_.runtime.ros2;
      if (ros2 && ros2->steps != nullptr) {
        return std::make_shared<ros2::NodeBehaviour>(ros2->steps, ros2::kClockPeriod);
      }
      if (ros2) return nullptr;
      return gateway::WrongField("behaviour",
                                 {base::ErrorCode::kInvalidArgument,
                                  "a robot with this behaviour needs --ros2", "--behaviour ros2"});
    }
    auto behaviour = Get(robot);
    if (behaviour) return *std::move(behaviour);
    return gateway::WrongField("behaviour", behaviour.error());
  }

 private:
  base::Result<std::shared_ptr<simulation::BehaviourPort>> Get(const scenario::RobotEntry& robot) {
    if (options_.make_behaviour) return options_.make_behaviour(robot.name, robot.behaviour, from_);
    if (!robot.behaviour_constraint.empty())
      return runtime_.behaviours().Get(robot.behaviour_constraint);
    if (options_.in_process) return InProcessBehaviour(robot.behaviour);
    return runtime_.behaviours().Get(services::ConstraintForName(robot.behaviour));
  }

  Runtime& runtime_;
  const RunOptions& options_;
  const base::SimTime from_;
};

// Returns the robots and avatars for which the scenario has a start, each with its actual start.
scenario::Scenario StartsOf(const Population& population, const scenario::Scenario& asked) {
  scenario::Scenario starts;
  const auto add = [](const std::vector<PlacedRobot>& placed,
                      const std::vector<scenario::RobotEntry>& entries,
                      std::vector<scenario::RobotEntry>& out) {
    for (const PlacedRobot& robot : placed) {
      if (robot.index < entries.size() && entries[robot.index].start) out.push_back(robot.entry);
    }
  };
  add(population.robots, asked.robots, starts.robots);
  add(population.avatars, asked.avatars, starts.avatars);
  return starts;
}

// Returns a scenario that repeats this run: with absolute paths, and with the actual names and
// poses.
scenario::Scenario ActualScenario(const Simulation& simulation, const RunOptions& options,
                                  const Population& population) {
  scenario::Scenario actual = recording::ScenarioOf(simulation);
  const scenario::Scenario& given = options.scenario;
  actual.world = AbsoluteIfExists(given.world);
  actual.in_process = options.in_process;
  for (const std::string& path : given.model_path)
    actual.model_path.push_back(AbsoluteIfExists(path));
  actual.robots.clear();
  actual.avatars.clear();
  for (const PlacedRobot& robot : population.robots) {
    const bool does_nothing = robot.entry.model.empty() && robot.entry.behaviour.empty() &&
                              robot.entry.behaviour_constraint.empty() && robot.entry.drive.empty();
    if (!does_nothing) actual.robots.push_back(robot.entry);
  }
  for (const PlacedRobot& avatar : population.avatars) actual.avatars.push_back(avatar.entry);
  for (auto* entries : {&actual.robots, &actual.avatars}) {
    for (scenario::RobotEntry& entry : *entries) entry.model = AbsoluteIfExists(entry.model);
  }
  actual.record_topics = given.record_topics;
  const RecordingChoice& choice = options.recording;
  actual.record_rates = {{"poses", choice.poses_rate},
                         {"readings", choice.readings_rate},
                         {"pictures", choice.images_rate},
                         {"beams", choice.beams_rate}};
  actual.record_png = given.record_png;
  actual.expect = given.expect;
  return actual;
}

}  // namespace

base::Result<std::shared_ptr<simulation::BehaviourPort>> LateBehaviour(
    Runtime& runtime, const RunOptions& options, const scenario::RobotEntry& robot,
    base::SimTime from) {
  RunBehaviours behaviours(runtime, options, from);
  if (auto ok = behaviours.Ensure({{robot, 0}}); !ok) return base::Fail(ok.error());
  auto behaviour = behaviours.Make(robot);
  if (!behaviour) return base::Fail(behaviour.error().error);
  return *std::move(behaviour);
}

base::Result<scenario::Scenario> PopulateRun(Runtime& runtime, Simulation& simulation,
                                             const RunOptions& options, base::Problems& problems) {
  formats::ModelLibrary& library = runtime.host().library();
  std::vector<std::string> of_world;
  for (const auto& robot : simulation.status().robots) {
    // --behaviour NAME does not apply to stations. A station gets a behaviour only if the option
    // contains the station's name: --behaviour STATION=NAME.
    if (!robot.is_station || options.behaviour_of.contains(robot.name)) {
      of_world.push_back(robot.name);
    }
  }
  scenario::Scenario scenario = options.scenario;
  if (auto ok = OverrideMovements(options, simulation, library, problems, scenario); !ok)
    return base::Fail(ok.error());
  auto population = Populate(simulation, library, scenario, problems, options.placing);
  if (!population) return base::Fail(population.error().error);
  for (base::Problem& problem :
       CheckStarts(simulation.snapshot(), StartsOf(*population, options.scenario))) {
    problems.push_back(std::move(problem));
  }
  if (auto ok = CheckNamespaces(options, simulation); !ok) return base::Fail(ok.error());
  AddRobotsOfTheWorld(simulation, population->robots, of_world);
  if (auto ok = OverrideBehaviours(options, population->robots); !ok) return base::Fail(ok.error());
  if (!options.behaviour.empty() && population->robots.empty()) {
    problems.push_back({base::Problem::Severity::kWarning,
                        "has no effect: there is no robot; add one with --robot MODEL",
                        "--behaviour " + options.behaviour});
  }
  RunBehaviours behaviours(runtime, options);
  if (auto ok = behaviours.Ensure(population->robots); !ok) return base::Fail(ok.error());
  const auto given = GiveBehaviours(simulation, population->robots,
                                    [&](const auto& robot) { return behaviours.Make(robot); });
  if (!given) return base::Fail(given.error().error);
  return ActualScenario(simulation, options, *population);
}

}  // namespace gsv::app
