#include "apps/gsv/running/run_options.h"

#include <cmath>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/serving/limit_option.h"
#include "apps/gsv/simulations/robot_drives.h"
#include "apps/gsv/simulations/sensor_types.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::app {

void AddRunOptions(CLI::App& command, RunArguments& a) {
  command.add_option(
      "world", a.world,
      "a world's file, a model to use as one, one of ours (office, maze, "
      "warehouse, yard, playground, hall), or a scenario, NAME.yaml, which says all of it "
      "and over which the options go; without one: the office with five robots");
  command.add_option("--name", a.name, "of the simulation; without it: simulation");
  command.add_option(
      "--robot", a.robots,
      "MODEL[@x,y[,yaw]]: a robot and where it starts; metres, yaw in radians or as 90deg");
  command.add_option("--behaviour", a.behaviours,
                     "NAME for all robots, or ROBOT=NAME for one: a behaviour that is offered, or "
                     "a program gsv-NAME to start; its options may follow: 'goto --goal-x 3'");
  command.add_option(
      "--movement", a.movements,
      "ROBOT=rigid (a name, or a model of --robot): by forces, as its wheels roll; ROBOT=planar: "
      "by its drive alone, over level ground. Without it: as its model says, else planar");
  command.add_option(
      "--drive", a.drives,
      "ROBOT=KIND[,KEY=VALUE]...: drive, as husky=skid,radius=0.16 (default: model's or guess)");
  command.add_flag("--in-process", a.in_process,
                   "run the behaviours inside gsv, from their plug-ins gsv-NAME.so: the same "
                   "outcome, and many more robots");
  command
      .add_option("--threads", a.threads,
                  "threads that move bodies and run behaviours in process; 0: in lockstep as many "
                  "as there are processors, else one. The outcome is the same")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command.add_option("--avatar", a.avatars,
                     "MODEL[@x,y[,yaw]]: a person in the world, steered from the viewer");
  command.add_option("--pedestrians", a.pedestrians,
                     "COUNT@x,y[,radius][:x,y[,radius]...]: people who walk from place to place");
  CLI::Option* lockstep = command.add_flag(
      "--lockstep", a.lockstep,
      "as fast as possible and reproducible: every step waits for every behaviour");
  command
      .add_flag("--real-time", a.real_time,
                "paced by the wall clock, also where a scenario says lockstep")
      ->excludes(lockstep);
  command.add_option("--factor", a.factor, "simulated seconds a wall second, in real time")
      ->default_str("1");
  command.add_option("--duration", a.duration,
                     "simulated seconds after which the run ends; without it: Ctrl-C");
  command.add_option("--step", a.step, "seconds a step; without it: the world's max_step_size");
  command.add_option("--seed", a.seed, "seed of all noise")->default_str("0");
  command
      .add_option("--deadline", a.deadline, "wall seconds a behaviour may run before it must wait")
      ->default_str("10");
  command
      .add_option("--on-failure", a.mode_on_failure,
                  "when a behaviour dies or hangs: go_on or fail")
      ->check(CLI::IsMember({"go_on", "fail"}))
      ->default_str("go_on");
  command
      .add_option("--wall-timeout", a.wall_timeout,
                  "wall seconds after which the run is given up with exit code 124")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--record", a.record,
                  "write a recording: NAME.mcap is a bare file, NAME a folder that rosbag2 opens")
      ->check([](const std::string& name) {
        return name == "true" || name == "false"
                   ? "it is a file, NAME.mcap, or a folder, found \"" + name + "\""
                   : std::string();
      });
  command
      .add_option("--record-topics", a.record_topics,
                  "record these only, separated by commas; with a slash at its end a topic stands "
                  "for all below it. A replay needs /gsv/poses")
      ->delimiter(',');
  command
      .add_option("--record-rate", a.record_rates,
                  "KIND=HZ of simulated time, separated by commas: poses=50, readings=20, "
                  "pictures=1, beams=10 if not said otherwise")
      ->delimiter(',');
  command.add_option("--record-pictures", a.record_pictures, "jpeg or png")
      ->check(CLI::IsMember({"jpeg", "png"}))
      ->default_str("jpeg");
  command
      .add_option("--broker", a.broker,
                  "a broker, corbaloc::1.2@HOST:PORT/TradingService; without it: one of its own")
      ->envname("GSV_BROKER");
  command.add_option("--model-path", a.model_path, "a folder to look for models in");
  AddSensorPluginOption(command, a.sensor_plugins);
  AddLimitOption(command, a.limits, a.server_limits);
  AddViewerOptions(command, a.web);
  AddRecordingsOption(command, a.web);
  command.add_flag("--strict", a.strict,
                   "refuse to run when files are repaired or not carried out in full");
  command.add_flag("--headless", a.headless, "without a viewer");
  command.add_flag("--open", a.open, "open the viewer in a browser");
  command.add_option("--failure-picture", a.failure_picture,
                     "a file, .jpg or .png, for a picture of the world when an expectation of the "
                     "scenario is first violated");
  command.add_flag("--json", a.json, "the last line on stdout is the result as JSON");
}

namespace {

constexpr double kDeadline = 10;  // s of wall time

base::Result<base::SimTime> Time(double seconds, const char* option) {
  if (!std::isfinite(seconds) || seconds < 0 || seconds > 1e9) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "must be a number of seconds from 0 to 1e9", option);
  }
  return base::FromSeconds(seconds);
}

base::Status UnderstandBehaviours(const std::vector<std::string>& texts, RunOptions& options) {
  for (const std::string& text : texts) {
    // What comes after a blank is the behaviour's own.
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

base::Status UnderstandMovements(const std::vector<std::string>& texts, RunOptions& options) {
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

base::Status UnderstandTopics(const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) {
    if (topic.starts_with('/')) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a topic begins with a slash, as /gsv/poses and /ROBOT/SENSOR do",
                      "--record-topics " + topic);
  }
  return {};
}

base::Status UnderstandRobots(const std::vector<std::string>& texts,
                              std::vector<scenario::RobotEntry>& robots) {
  for (const std::string& text : texts) {
    auto robot = scenario::ParseRobot(text);
    if (!robot) return base::Fail(robot.error());
    robots.push_back(*std::move(robot));
  }
  return {};
}

// What the file says, or what stands for it.
base::Result<scenario::Scenario> ScenarioToStartFrom(const RunArguments& a,
                                                     base::Problems& problems) {
  scenario::Scenario scenario;
  if (scenario::IsScenarioFileName(a.world)) {
    auto read = scenario::ReadScenario(a.world, problems);
    if (!read) return read;
    scenario = *std::move(read);
  } else if (a.world.empty() && a.robots.empty()) {
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

// What the command line says goes over what the file says.
void Override(scenario::Scenario& scenario, const RunArguments& a) {
  if (!a.name.empty()) scenario.name = a.name;
  Override(scenario.seed, a.seed);
  Override(scenario.factor, a.factor);
  Override(scenario.step, a.step);
  Override(scenario.duration, a.duration);
  Override(scenario.deadline, a.deadline);
  if (a.lockstep) scenario.lockstep = true;
  if (a.real_time) scenario.lockstep = false;
  if (a.in_process) scenario.in_process = true;
  if (!a.mode_on_failure.empty()) scenario.fails_with_behaviour = a.mode_on_failure == "fail";
  scenario.model_path.insert(scenario.model_path.begin(), a.model_path.begin(), a.model_path.end());
  if (!a.record.empty()) scenario.record = a.record;
  if (!a.record_topics.empty()) scenario.record_topics = a.record_topics;
  if (!a.record_pictures.empty()) scenario.record_png = a.record_pictures == "png";
}

// Options that have no effect with the others. A scenario's file may say what they go with.
base::Problems CheckOptions(const RunArguments& a, const scenario::Scenario& scenario) {
  base::Problems problems = CheckModelPath(scenario.model_path);
  const auto warn = [&](bool is_given, const char* option, const char* why) {
    if (!is_given) return;
    problems.push_back({base::Problem::Severity::kWarning, why, option});
  };
  const bool is_lockstep = scenario.lockstep.value_or(false);
  warn(is_lockstep && a.factor, "--factor",
       "has no effect with --lockstep, which runs as fast as it can");
  warn(a.headless && a.open, "--open", "has no effect with --headless: there is no viewer");
  warn(a.headless && a.web.port >= 0, "--port",
       "has no effect with --headless: there is no viewer");
  warn(a.headless && !a.web.names.empty(), "--allow-host",
       "has no effect with --headless: there is no viewer");
  warn(!a.failure_picture.empty() && scenario.expect.empty(), "--failure-picture",
       "has no effect: only a scenario with expectations can fail one");
  return problems;
}

base::Status UnderstandTimes(const scenario::Scenario& scenario,
                             simulation::Specification& specification) {
  const auto duration = Time(scenario.duration.value_or(0), "--duration");
  const auto step = Time(scenario.step.value_or(0), "--step");
  const auto deadline = Time(scenario.deadline.value_or(kDeadline), "--deadline");
  for (const auto* time : {&duration, &step, &deadline}) {
    if (!*time) return base::Fail(time->error());
  }
  specification.duration = *duration;
  specification.step = *step;
  specification.deadline = std::chrono::duration_cast<std::chrono::milliseconds>(*deadline);
  return {};
}

base::Status UnderstandRecording(const RunArguments& a, RunOptions& options) {
  const scenario::Scenario& scenario = options.scenario;
  if (auto ok = UnderstandTopics(scenario.record_topics); !ok) return ok;
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
                                             {"--record-pictures", !a.record_pictures.empty()}};
  for (const auto& [option, is_given] : given) {
    if (!is_given || !options.record.empty()) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument, "goes with --record NAME", option);
  }
  return {};
}

void UnderstandSpecification(const RunArguments& a, const scenario::Scenario& scenario,
                             simulation::Specification& specification) {
  specification.name = scenario.name.empty() ? "simulation" : scenario.name;
  specification.mode =
      scenario.lockstep.value_or(false) ? simulation::Mode::kLockstep : simulation::Mode::kRealTime;
  specification.factor = scenario.factor.value_or(1);
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

base::Result<RunOptions> Understand(const RunArguments& a) {
  RunOptions options;
  auto scenario = ScenarioToStartFrom(a, options.problems);
  if (!scenario) return base::Fail(scenario.error());
  options.scenario = *std::move(scenario);
  Override(options.scenario, a);
  for (base::Problem& problem : CheckOptions(a, options.scenario)) {
    options.problems.push_back(std::move(problem));
  }
  if (auto ok = UnderstandRobots(a.robots, options.scenario.robots); !ok)
    return base::Fail(ok.error());
  if (auto ok = UnderstandRobots(a.avatars, options.scenario.avatars); !ok)
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
  if (auto ok = UnderstandBehaviours(a.behaviours, options); !ok) return base::Fail(ok.error());
  if (auto ok = UnderstandMovements(a.movements, options); !ok) return base::Fail(ok.error());
  auto drives = ParseDrives(a.drives);
  if (!drives) return base::Fail(drives.error());
  options.drive_of = *std::move(drives);
  UnderstandSpecification(a, options.scenario, options.specification);
  if (auto ok = UnderstandTimes(options.scenario, options.specification); !ok)
    return base::Fail(ok.error());
  if (auto ok = UnderstandRecording(a, options); !ok) return base::Fail(ok.error());

  options.in_process = options.scenario.in_process.value_or(false);
  options.runtime.broker = a.broker;
  options.runtime.model_path.assign(options.scenario.model_path.begin(),
                                    options.scenario.model_path.end());
  options.runtime.sensors.plugins.assign(a.sensor_plugins.begin(), a.sensor_plugins.end());
  options.runtime.limits = a.limits;
  options.runtime.server_limits = a.server_limits;
  options.runtime.viewer = !a.headless;
  options.runtime.web = a.web;
  options.wall_timeout = a.wall_timeout;
  options.failure_picture = a.failure_picture;
  options.open_browser = a.open;
  options.json = a.json;
  options.is_strict = a.strict;
  return options;
}

}  // namespace gsv::app
