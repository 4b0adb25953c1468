#include "apps/gsv/running/run_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/serving/limit_option.h"
#include "apps/gsv/simulations/robot_drives.h"
#include "apps/gsv/simulations/sensor_types.h"
#include "gsv/base/spelling.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::app {

namespace {

void AddWorldOptions(CLI::App& command, RunArguments& a) {
  constexpr const char* kGroup = "World and robots";
  command.add_option(
      "world", a.world,
      "world, built-in world, model, or scenario NAME.yaml (default: office with five robots)\n"
      "Built-in worlds are office, maze, warehouse, yard, playground and hall. The options "
      "override the scenario file.");
  command.add_option("--robot", a.robots, "add a robot at a pose (m, rad; yaw also as 90deg)")
      ->type_name("MODEL[@X,Y[,YAW]]")
      ->group(kGroup);
  command
      .add_option(
          "--place", a.place,
          "add N robots: grid:N on a grid, or random:N at random places (default model: pebble)\n"
          "For another model, add --robot MODEL without a pose. The grid has cells of 1 m. "
          "--seed determines the random places.")
      ->type_name("WHERE")
      ->group(kGroup);
  command.add_option("--avatar", a.avatars, "add an avatar that people steer from the viewer")
      ->type_name("MODEL[@X,Y[,YAW]]")
      ->group(kGroup);
  command
      .add_option(
          "--pedestrians", a.pedestrians,
          "add pedestrians who walk from place to place\n"
          "Separate places by colons. For example, 20@-4,0,1:4,0,1 means 20 pedestrians and two "
          "places with a radius of 1 m.")
      ->type_name("COUNT@X,Y[,RADIUS]...")
      ->group(kGroup);
  command
      .add_option("--movement", a.movements,
                  "rigid-body dynamics, or 2D kinematics on level ground (default: by the model)\n"
                  "If the model file does not set the movement, a robot with a drive is planar. A "
                  "robot without a drive is never planar. ROBOT is the name of a robot, or a model "
                  "of --robot.")
      ->type_name("ROBOT=rigid|planar")
      ->group(kGroup);
  command
      .add_option("--drive", a.drives,
                  "drive of a robot, such as husky=skid,radius=0.16\n"
                  "Without this option, the model file defines the drive, or gsv guesses it.")
      ->type_name("ROBOT=KIND[,KEY=VALUE]")
      ->group(kGroup);
  command.add_option("--model-path", a.model_path, "folder to search for models")
      ->type_name("FOLDER")
      ->group(kGroup);
  AddSensorPluginOption(command, a.sensor_plugins)->group(kGroup);
  command.add_option("--name", a.name, "name of the simulation (default: simulation)")
      ->type_name("NAME")
      ->group(kGroup);
  command.add_option("--seed", a.seed, "seed of all noise")
      ->default_str("0")
      ->type_name("N")
      ->group(kGroup);
  command
      .add_flag(
          "--strict", a.strict,
          "refuse to run when there are warnings\nWarnings concern elements of files that gsv "
          "repairs or does not support, start poses, missing folders, and options without "
          "effect.")
      ->group(kGroup);
}

void AddBehaviourOptions(CLI::App& command, RunArguments& a) {
  constexpr const char* kGroup = "Behaviours";
  command
      .add_option(
          "--behaviour", a.behaviours,
          "behaviour of all robots, or of one robot\n"
          "Options of the behaviour may follow its name, such as 'goto "
          "--goal-x 3'. "
          "NAME is a behaviour that the broker offers, or a program gsv-NAME to start. With "
          "--ros2, NAME may also be ros2: ROS 2 nodes drive the robot.")
      ->type_name("[ROBOT=]NAME")
      ->group(kGroup);
  command
      .add_flag("--in-process", a.in_process,
                "run behaviours inside gsv, from plug-ins gsv-NAME.so\n"
                "Programs give the same results, but plug-ins allow many more robots on a machine.")
      ->group(kGroup);
  command
      .add_option("--on-failure", a.mode_on_failure,
                  "reaction to a crash or hang of a behaviour: continue, or fail the run")
      ->check(OneOf({"go_on", "fail"}))
      ->default_str("go_on")
      ->type_name("go_on|fail")
      ->group(kGroup);
  command
      .add_option(
          "--stuck-after", a.stuck_after,
          "a robot that does not move for this simulated time, despite commands to move, is stuck")
      ->default_str("5")
      ->check(Between(0.1, 1e9))
      ->type_name("SECONDS")
      ->group(kGroup);
  command
      .add_option("--deadline", a.deadline,
                  "maximum wall-clock time that a behaviour may take between two waits\n"
                  "A wait is a call that waits for an instant of simulated time.")
      ->default_str("10")
      ->type_name("SECONDS")
      ->group(kGroup);
}

void AddTimeOptions(CLI::App& command, RunArguments& a) {
  constexpr const char* kGroup = "Time";
  CLI::Option* lockstep = command
                              .add_flag("--lockstep", a.lockstep,
                                        "run as fast as possible, with reproducible results\n"
                                        "Every step waits for every behaviour.")
                              ->group(kGroup);
  command.add_flag("--real-time", a.real_time, "follow the wall clock, even in lockstep scenarios")
      ->excludes(lockstep)
      ->group(kGroup);
  command
      .add_option("--real-time-factor,--factor", a.factor,
                  "simulated seconds per wall-clock second\n"
                  "--factor is the former name of this option.")
      ->default_str("from the world")
      ->type_name("F")
      ->group(kGroup);
  command.add_option("--duration", a.duration, "simulated time of the run (default: until Ctrl-C)")
      ->type_name("SECONDS")
      ->group(kGroup);
  command.add_option("--step", a.step, "simulated time of a step (default: from the world)")
      ->type_name("SECONDS")
      ->group(kGroup);
  command
      .add_option("--threads", a.threads,
                  "threads for physics and behaviours (default: 0)\n"
                  "0 means one per processor in lockstep, else one. Of the behaviours, only those "
                  "with --in-process use these threads. The number does not change the results.")
      ->check(Between(0, 256))
      ->type_name("N")
      ->group(kGroup);
}

void AddRecordOptions(CLI::App& command, RunArguments& a) {
  constexpr const char* kGroup = "Recording";
  command.add_option("--record", a.record, "record to file NAME.mcap or to rosbag2 folder NAME")
      ->check([](const std::string& name) {
        return name == "true" || name == "false"
                   ? "expected a file NAME.mcap or a folder, found \"" + name + "\""
                   : std::string();
      })
      ->type_name("NAME")
      ->group(kGroup);
  command
      .add_option("--record-topics", a.record_topics,
                  "topics to record; TOPIC/ selects all topics below\n"
                  "Topics are separated by commas. A replay needs /gsv/poses.")
      ->delimiter(',')
      ->type_name("TOPIC,...")
      ->group(kGroup);
  command
      .add_option("--record-rate", a.record_rates,
                  "rates in simulated time (default: poses=50,readings=20,pictures=1,beams=10)")
      ->delimiter(',')
      ->type_name("KIND=HZ,...")
      ->group(kGroup);
  command.add_option("--record-pictures", a.record_images, "encoding of recorded images")
      ->check(OneOf({"jpeg", "png"}))
      ->default_str("jpeg")
      ->type_name("jpeg|png")
      ->group(kGroup);
  command
      .add_option(
          "--failure-picture", a.failure_image,
          "write an image of the world at the first violation of an expectation (.jpg, .png)")
      ->type_name("FILE")
      ->group(kGroup);
}

}  // namespace

void AddRunOptions(CLI::App& command, RunArguments& a) {
  AddWorldOptions(command, a);
  AddBehaviourOptions(command, a);
  AddTimeOptions(command, a);
  AddRecordOptions(command, a);
  command.add_flag("--headless", a.headless, "start no viewer")->group(kViewerGroup);
  command.add_flag("--open", a.open, "open the viewer in a browser")->group(kViewerGroup);
  AddViewerOptions(command, a.web);
  AddRecordingsOption(command, a.web);
  AddRos2Options(command, a.ros2);
  AddBrokerOption(command, a.broker);
  AddLimitOption(command, a.limits, a.server_limits)->group("Limits");
  command
      .add_option("--wall-timeout", a.wall_timeout,
                  "abort after this wall-clock time (exit code 124)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("SECONDS")
      ->group("Limits");
  command.add_flag("--json", a.json, "print the result as JSON on the last line");
}

namespace {

constexpr double kDeadline = 10;  // wall-clock time, s

base::Result<base::SimTime> Time(double seconds, const char* option) {
  if (!std::isfinite(seconds) || seconds < 0 || seconds > 1e9) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "must be a number of seconds from 0 to 1e9", option);
  }
  return base::FromSeconds(seconds);
}

base::Status ParseBehaviours(const std::vector<std::string>& texts, RunOptions& options) {
  for (const std::string& text : texts) {
    // The text after the first space has the behaviour's own options.
    const std::size_t equals = text.substr(0, text.find(' ')).find('=');
    if (equals == std::string::npos) {
      options.behaviour = text;
    } else if (equals == 0 || equals + 1 == text.size()) {
      return base::Fail(base::ErrorCode::kInvalidArgument, "expected NAME or ROBOT=NAME",
                        "--behaviour " + text);
    } else {
      options.behaviour_of[text.substr(0, equals)] = text.substr(equals + 1);
    }
  }
  return {};
}

base::Status ParseMovements(const std::vector<std::string>& texts, RunOptions& options) {
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string how = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (equals == 0 || (how != "rigid" && how != "planar")) {
      return base::Fail(base::ErrorCode::kInvalidArgument, "expected ROBOT=rigid or ROBOT=planar",
                        "--movement " + text);
    }
    options.movement_of[text.substr(0, equals)] =
        how == "rigid" ? model::Movement::kRigid : model::Movement::kPlanar;
  }
  return {};
}

base::Status CheckTopics(const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) {
    if (topic.starts_with('/')) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a topic must begin with a slash, such as /gsv/poses or /ROBOT/SENSOR",
                      "--record-topics " + topic);
  }
  return {};
}

constexpr int kMaxPlaced = 2000;

// Parses --place, such as "grid:50" or "random:50". Makes this number of copies of the robot that
// was given without a pose.
base::Status ParsePlace(const std::string& text, std::vector<scenario::RobotEntry>& robots,
                        RunOptions& options) {
  if (text.empty()) return {};
  const auto fail = [&](std::string message) {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(message), "--place " + text);
  };
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string kind = text.substr(0, colon);
  int count = 0;
  const char* const begin = text.data() + std::min(colon + 1, text.size());
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, count);
  if (kind != "grid" && kind != "random") {
    return fail("expected grid:N or random:N" + base::DidYouMean(kind, {"grid", "random"}));
  }
  if (error != std::errc() || rest != end || count < 1 || count > kMaxPlaced) {
    return fail("expected a number of robots from 1 to " + std::to_string(kMaxPlaced) + " after " +
                kind + ":");
  }
  std::vector<std::size_t> without_place;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!robots[i].start) without_place.push_back(i);
  }
  if (without_place.size() > 1)
    return fail("needs one --robot MODEL without a pose, found several");
  scenario::RobotEntry robot{.model = "pebble"};
  if (!without_place.empty()) {
    robot = robots[without_place[0]];
    robots.erase(robots.begin() + static_cast<std::ptrdiff_t>(without_place[0]));
  }
  robots.insert(robots.end(), static_cast<std::size_t>(count), robot);
  options.placing = {kind == "grid" ? Placing::Kind::kGrid : Placing::Kind::kRandom, count,
                     options.scenario.seed.value_or(0)};
  return {};
}

base::Status ParseRobots(const std::vector<std::string>& texts,
                         std::vector<scenario::RobotEntry>& robots) {
  for (const std::string& text : texts) {
    auto robot = scenario::ParseRobot(text);
    if (!robot) return base::Fail(robot.error());
    robots.push_back(*std::move(robot));
  }
  return {};
}

// Returns the scenario of the file, or the default scenario if there is no file.
base::Result<scenario::Scenario> ScenarioToStartFrom(const RunArguments& a,
                                                     base::Problems& problems) {
  scenario::Scenario scenario;
  if (scenario::IsScenarioFileName(a.world)) {
    auto read = scenario::ReadScenario(a.world, problems);
    if (!read) return read;
    scenario = *std::move(read);
  } else if (a.world.empty() && a.robots.empty() && a.place.empty()) {
    return scenario::DefaultScenario();
  } else {
    scenario.world = a.world;
  }
  if (scenario.world.empty()) scenario.world = scenario::DefaultScenario().world;
  return scenario;
}

template <typename Value>
void Override(std::optional<Value>& value, const std::optional<Value>& given) {
  if (given) value = given;
}

// Options override the scenario file.
void Override(scenario::Scenario& scenario, const RunArguments& a) {
  if (!a.name.empty()) scenario.name = a.name;
  Override(scenario.seed, a.seed);
  Override(scenario.factor, a.factor);
  Override(scenario.step, a.step);
  Override(scenario.duration, a.duration);
  Override(scenario.deadline, a.deadline);
  Override(scenario.stuck_after, a.stuck_after);
  if (a.lockstep) scenario.lockstep = true;
  if (a.real_time) scenario.lockstep = false;
  if (a.in_process) scenario.in_process = true;
  if (!a.mode_on_failure.empty()) scenario.fails_with_behaviour = a.mode_on_failure == "fail";
  scenario.model_path.insert(scenario.model_path.begin(), a.model_path.begin(), a.model_path.end());
  if (!a.record.empty()) scenario.record = a.record;
  if (!a.record_topics.empty()) scenario.record_topics = a.record_topics;
  if (!a.record_images.empty()) scenario.record_png = a.record_images == "png";
}

// Returns warnings about options that have no effect in combination with other options or with the
// scenario file.
base::Problems CheckOptions(const RunArguments& a, const scenario::Scenario& scenario) {
  base::Problems problems = CheckModelPath(scenario.model_path);
  const auto warn = [&](bool is_given, const char* option, const char* why) {
    if (!is_given) return;
    problems.push_back({base::Problem::Severity::kWarning, why, option});
  };
  const bool is_lockstep = scenario.lockstep.value_or(false);
  warn(is_lockstep && a.factor, "--real-time-factor",
       "has no effect with --lockstep, which runs as fast as it can");
  warn(a.headless && a.open, "--open", "has no effect with --headless: there is no viewer");
  warn(a.headless && a.web.port >= 0, "--port",
       "has no effect with --headless: there is no viewer");
  warn(a.headless && !a.web.names.empty(), "--allow-host",
       "has no effect with --headless: there is no viewer");
  warn(!a.failure_image.empty() && scenario.expect.empty(), "--failure-picture",
       "has no effect, because there are no expectations; use a scenario that has some");
  return problems;
}

base::Status SetTimes(const scenario::Scenario& scenario,
                      simulation::Specification& specification) {
  const auto duration = Time(scenario.duration.value_or(0), "--duration");
  const auto step = Time(scenario.step.value_or(0), "--step");
  const auto deadline = Time(scenario.deadline.value_or(kDeadline), "--deadline");
  for (const auto* time : {&duration, &step, &deadline}) {
    if (!*time) return base::Fail(time->error());
  }
  specification.duration = *duration;
  specification.step = *step;
  if (scenario.stuck_after) specification.stuck_after = base::FromSeconds(*scenario.stuck_after);
  specification.deadline = std::chrono::duration_cast<std::chrono::milliseconds>(*deadline);
  return {};
}

base::Status SetRecording(const RunArguments& a, RunOptions& options) {
  const scenario::Scenario& scenario = options.scenario;
  if (auto ok = CheckTopics(scenario.record_topics); !ok) return ok;
  options.record = scenario.record;
  options.recording.topics = scenario.record_topics;
  options.recording.png = scenario.record_png.value_or(false);
  for (const auto& [kind, rate] : scenario.record_rates) {
    if (auto ok = SetRate(fmt::format("{}={}", kind, rate), options.recording); !ok) return ok;
  }
  for (const std::string& rate : a.record_rates) {
    if (auto ok = SetRate(rate, options.recording); !ok) return ok;
  }
  const std::pair<const char*, bool> given[]{{"--record-topics", !a.record_topics.empty()},
                                             {"--record-rate", !a.record_rates.empty()},
                                             {"--record-pictures", !a.record_images.empty()}};
  for (const auto& [option, is_given] : given) {
    if (!is_given || !options.record.empty()) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument, "has an effect only with --record NAME",
                      option);
  }
  return {};
}

void SetSpecification(const RunArguments& a, const scenario::Scenario& scenario,
                      simulation::Specification& specification) {
  specification.name = scenario.name.empty() ? "simulation" : scenario.name;
  specification.mode =
      scenario.lockstep.value_or(false) ? simulation::Mode::kLockstep : simulation::Mode::kRealTime;
  specification.factor = scenario.factor.value_or(0);  // 0: the factor of the world file
  specification.seed = scenario.seed.value_or(0);
  specification.on_failure = scenario.fails_with_behaviour.value_or(false)
                                 ? simulation::FailurePolicy::kFail
                                 : simulation::FailurePolicy::kContinue;
  specification.faults = scenario.faults;
  specification.pedestrians = scenario.pedestrians;
  specification.keep = true;
  specification.threads = a.threads;
}

}  // namespace

base::Result<RunOptions> ParseArguments(const RunArguments& a) {
  RunOptions options;
  auto scenario = ScenarioToStartFrom(a, options.problems);
  if (!scenario) return base::Fail(scenario.error());
  if (a.factor && !(*a.factor > 0)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "must be above 0", "--real-time-factor");
  }
  options.scenario = *std::move(scenario);
  Override(options.scenario, a);
  for (base::Problem& problem : CheckOptions(a, options.scenario)) {
    options.problems.push_back(std::move(problem));
  }
  std::vector<scenario::RobotEntry> robots;
  if (auto ok = ParseRobots(a.robots, robots); !ok) return base::Fail(ok.error());
  if (auto ok = ParsePlace(a.place, robots, options); !ok) return base::Fail(ok.error());
  std::move(robots.begin(), robots.end(), std::back_inserter(options.scenario.robots));
  if (auto ok = ParseRobots(a.avatars, options.scenario.avatars); !ok)
    return base::Fail(ok.error());
  for (const std::string& text : a.pedestrians) {
    auto group = scenario::ParsePedestrians(text);
    if (!group) {
      base::Error error = group.error();
      error.where = "--pedestrians " + text;
      return base::Fail(std::move(error));
    }
    options.scenario.pedestrians.push_back(*std::move(group));
  }
  if (auto ok = ParseBehaviours(a.behaviours, options); !ok) return base::Fail(ok.error());
  if (auto ok = ParseMovements(a.movements, options); !ok) return base::Fail(ok.error());
  auto drives = ParseDrives(a.drives);
  if (!drives) return base::Fail(drives.error());
  options.drive_of = *std::move(drives);
  SetSpecification(a, options.scenario, options.specification);
  if (auto ok = SetTimes(options.scenario, options.specification); !ok)
    return base::Fail(ok.error());
  if (auto ok = SetRecording(a, options); !ok) return base::Fail(ok.error());

  options.in_process = options.scenario.in_process.value_or(false);
  options.runtime.broker = a.broker;
  options.runtime.model_path.assign(options.scenario.model_path.begin(),
                                    options.scenario.model_path.end());
  options.runtime.sensors.plugins.assign(a.sensor_plugins.begin(), a.sensor_plugins.end());
  options.runtime.limits = a.limits;
  options.runtime.server_limits = a.server_limits;
  options.runtime.viewer = !a.headless;
  options.runtime.web = a.web;
  auto ros2 = ParseArguments(WithSettings(a.ros2, options.scenario.ros2));
  if (!ros2) return base::Fail(ros2.error());
  options.runtime.ros2 = *std::move(ros2);
  const bool is_stepped = options.runtime.ros2 && options.runtime.ros2->is_cmd_vel_stamped &&
                          options.specification.mode == simulation::Mode::kLockstep;
  if (is_stepped) options.runtime.ros2->steps = std::make_shared<ros2::NodeSteps>();
  options.wall_timeout = a.wall_timeout;
  options.failure_image = a.failure_image;
  options.open_browser = a.open;
  options.json = a.json;
  options.is_strict = a.strict;
  return options;
}

}  // namespace gsv::app
