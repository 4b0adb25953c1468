#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numeric>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/bench/bench.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/running/run_population.h"
#include "apps/gsv/scenes/crowd_scenario.h"
#include "gsv/base/mutex.h"
#include "gsv/base/sorting.h"
#include "gsv/sensing/forwarding_sensor.h"

namespace gsv::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSeparateCalls = "wander --no-pictures";
constexpr const char* kExchange = "cruise";
constexpr int kMaxOfficeRobots = 20;  // maximum number of robots in the office

// Collects durations in milliseconds, from any thread.
class Durations {
 public:
  void Add(Clock::duration duration) {
    const base::MutexLock lock(mutex_);
    values_.push_back(Milliseconds(duration));
  }
  std::size_t count() const {
    const base::MutexLock lock(mutex_);
    return values_.size();
  }
  double mean() const {
    const base::MutexLock lock(mutex_);
    return values_.empty() ? 0
                           : std::accumulate(values_.begin(), values_.end(), 0.0) /
                                 static_cast<double>(values_.size());
  }
  // Returns the `q`-quantile of the durations (nearest rank), such as the median for 0.5.
  double quantile(double q) const {
    const base::MutexLock lock(mutex_);
    if (values_.empty()) return 0;
    std::vector<double> sorted = values_;
    base::Sort(sorted);
    const auto rank = static_cast<std::size_t>(q * static_cast<double>(sorted.size()));
    return sorted[std::min(rank, sorted.size() - 1)];
  }

 private:
  mutable base::Mutex mutex_;
  std::vector<double> values_ GSV_GUARDED_BY(mutex_);
};

// Measures the intervals between state updates. Read its results only after the run.
class UpdateTimer final : public simulation::Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    const auto now = Clock::now();
    if (last_ != Clock::time_point()) intervals.Add(now - last_);
    last_ = now;
    last_time_ = snapshot->state.time;
    if (last_time_ > kStart) return;
    started_ = now;
    started_time_ = last_time_;
  }
  void OnEvent(const simulation::Event&) override {}

  // Returns the real-time factor without the first second of simulated time, in which all
  // behaviours start at once. Returns 0 if the run is not longer than this second.
  double factor_after_start() const {
    const double wall = Seconds(last_ - started_);
    return wall > 0 ? base::ToSeconds(last_time_ - started_time_) / wall : 0;
  }

  Durations intervals;

 private:
  static constexpr base::SimTime kStart = std::chrono::seconds(1);

  // Used by the stepping thread during the run.
  Clock::time_point last_, started_;
  base::SimTime last_time_{0}, started_time_{0};
};

// A camera that measures the time of each image, from request to image.
class TimedSensor final : public sensing::ForwardingSensor {
 public:
  TimedSensor(std::unique_ptr<sensing::Sensor> sensor, std::shared_ptr<Durations> times)
      : ForwardingSensor(std::move(sensor)), times_(std::move(times)) {}
  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    const auto start = Clock::now();
    auto reading = sensor().Sample(sampling);
    times_->Add(Clock::now() - start);
    return reading;
  }

 private:
  const std::shared_ptr<Durations> times_;
};

struct TypicalArguments {
  std::vector<int> robots{1, 2, 3, 4, 5};
  std::string world, model = "b21r", behaviour = "wander";
  double duration = 20;
  simulation::Mode mode = simulation::Mode::kRealTime;
  bool exchange = false, in_process = false, json = false;
};

struct Row {
  int robots = 0;
  std::string behaviour;
  simulation::SimulationStatus status;
  std::string state_hash;
  std::shared_ptr<UpdateTimer> updates = std::make_shared<UpdateTimer>();
  std::shared_ptr<Durations> images = std::make_shared<Durations>();
};

// Places the robots in the given world. If no world is given, up to kMaxOfficeRobots robots are in
// the office, and more robots are on the square of `gsv bench crowd`.
base::Status PlaceRobots(const TypicalArguments& arguments, int robots, RunOptions& options) {
  const bool on_the_square = arguments.world.empty() && robots > kMaxOfficeRobots;
  if (on_the_square) {
    options.specification.world = CrowdWorld(robots, 1);
  } else {
    auto file = FindWorld(arguments.world.empty() ? "office" : arguments.world);
    if (!file) return base::Fail(file.error());
    options.scenario.world = *std::move(file);
  }
  const auto places = CrowdRobots(robots, 1);
  for (int i = 0; i < robots; ++i) {
    std::optional<scenario::Place> start;
    if (on_the_square) {
      const geometry::Pose& place = places[static_cast<std::size_t>(i)].world_from_robot;
      start = {place.position.x, place.position.y, {}, geometry::Yaw(place.orientation)};
    }
    options.scenario.robots.push_back({.model = arguments.model, .start = start});
  }
  return {};
}

base::Result<Row> RunTypical(const TypicalArguments& arguments, int robots) {
  Row row;
  row.robots = robots;
  row.behaviour = arguments.behaviour;
  RunOptions options;
  options.runtime.viewer = false;
  options.runtime.sensors.adapt_camera = [times = row.images](sensing::SensorType& camera) {
    camera.create = [create = camera.create, times](const model::SensorDescription& description)
        -> base::Result<std::unique_ptr<sensing::Sensor>> {
      auto sensor = create(description);
      if (!sensor) return sensor;
      return std::make_unique<TimedSensor>(*std::move(sensor), times);
    };
  };
  if (auto ok = PlaceRobots(arguments, robots, options); !ok) return base::Fail(ok.error());
  options.behaviour = arguments.behaviour;
  options.in_process = arguments.in_process;
  options.specification.mode = arguments.mode;
  options.specification.duration = base::FromSeconds(arguments.duration);
  options.specification.keep = true;

  auto runtime = Runtime::Start(options.runtime);
  if (!runtime) return base::Fail(runtime.error());
  base::Problems problems;
  auto simulation =
      (*runtime)->host().Create(options.specification, options.scenario.world, problems);
  if (!simulation) return base::Fail(simulation.error());
  if (auto ok = PopulateRun(**runtime, **simulation, options, problems); !ok)
    return base::Fail(ok.error());
  (*simulation)->AddObserver(row.updates);
  if (auto ok = (*simulation)->Start(); !ok) return base::Fail(ok.error());
  const auto time_limit =
      std::chrono::milliseconds(static_cast<std::int64_t>(arguments.duration * 20'000) + 60'000);
  if ((*simulation)->WaitForPhase({simulation::Phase::kFinished}, time_limit) !=
      simulation::Phase::kFinished) {
    return base::Fail(base::ErrorCode::kTimeout, "the run did not finish in time");
  }
  row.status = (*simulation)->status();
  row.state_hash = (*simulation)->state_hash();
  return row;
}

// The number of control cycles per robot and second. A cycle reads eight sonars.
double CyclesPerRobotSecond(const Row& row) {
  double sonars = 0;
  for (const simulation::RobotStatus& robot : row.status.robots) {
    const auto readings = robot.readings.find("sonar");
    if (readings != robot.readings.end()) sonars += static_cast<double>(readings->second);
  }
  return sonars / 8 / row.robots / base::ToSeconds(row.status.time);
}

nlohmann::ordered_json ToJson(const Row& row) {
  return {{"robots", row.robots},
          {"behaviour", row.behaviour},
          {"real_time_factor", row.status.real_time_factor},
          {"real_time_factor_after_start", row.updates->factor_after_start()},
          {"update_interval_ms",
           {{"mean", row.updates->intervals.mean()},
            {"median", row.updates->intervals.quantile(0.5)},
            {"p99", row.updates->intervals.quantile(0.99)}}},
          {"step_ms", Milliseconds(row.status.mean_step_time)},
          {"camera_ms", {{"mean", row.images->mean()}, {"p99", row.images->quantile(0.99)}}},
          {"pictures_per_s",
           static_cast<double>(row.images->count()) / base::ToSeconds(row.status.time)},
          {"cycles_per_robot_s", CyclesPerRobotSecond(row)},
          {"late_steps", row.status.late_steps}};
}

int Typical(const TypicalArguments& arguments) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  if (!arguments.json) {
    std::printf(
        "robots  real time  after 1 s   update interval (ms)       step    camera (ms)     images  "
        "cycles   late\n");
    std::printf(
        "             x          x      mean  median     p99       (ms)    mean    p99   a second  "
        "/robot s steps\n");
  }
  for (const int robots : arguments.robots) {
    const auto row = RunTypical(arguments, robots);
    if (!row) return PrintError(row.error());
    const auto json = ToJson(*row);
    rows.push_back(json);
    if (arguments.json) continue;
    std::printf("%6d  %9.3f  %9.3f  %8.2f %7.2f %7.2f  %9.4f %7.2f %6.2f  %9.1f %7.1f  %6llu\n",
                robots, row->status.real_time_factor, row->updates->factor_after_start(),
                row->updates->intervals.mean(), row->updates->intervals.quantile(0.5),
                row->updates->intervals.quantile(0.99), json["step_ms"].get<double>(),
                row->images->mean(), row->images->quantile(0.99),
                json["pictures_per_s"].get<double>(), CyclesPerRobotSecond(*row),
                static_cast<unsigned long long>(row->status.late_steps));
    std::fflush(stdout);
  }
  if (arguments.json) std::printf("%s\n", nlohmann::ordered_json{{"rows", rows}}.dump().c_str());
  return kOk;
}

int Lockstep(const TypicalArguments& arguments) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  if (!arguments.json) std::printf("robots  behaviour               real time  hash\n");
  for (const int robots : arguments.robots) {
    for (const char* behaviour : {kSeparateCalls, kExchange}) {
      TypicalArguments one = arguments;
      one.behaviour = behaviour;
      const auto row = RunTypical(one, robots);
      if (!row) return PrintError(row.error());
      rows.push_back({{"robots", robots},
                      {"behaviour", behaviour},
                      {"real_time_factor", row->status.real_time_factor},
                      {"steps", row->status.step},
                      {"step_ms", Milliseconds(row->status.mean_step_time)},
                      {"state_hash", row->state_hash}});
      if (arguments.json) continue;
      std::printf("%6d  %-22s  %9.1f  %s\n", robots, behaviour, row->status.real_time_factor,
                  row->state_hash.c_str());
      std::fflush(stdout);
    }
  }
  if (arguments.json) std::printf("%s\n", nlohmann::ordered_json{{"rows", rows}}.dump().c_str());
  return kOk;
}

std::shared_ptr<TypicalArguments> AddCommon(CLI::App& command, std::vector<int> robots) {
  auto arguments = std::make_shared<TypicalArguments>();
  arguments->robots = std::move(robots);
  command.add_option("--robots", arguments->robots, "numbers of robots, one row for each")
      ->type_name("N,...")
      ->delimiter(',')
      ->capture_default_str()
      ->check(Between(1, 5000));
  command.add_option("--duration", arguments->duration, "simulated time per row")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(Between(1.0, 3600.0));
  command
      .add_option(
          "--world", arguments->world,
          "world (default: office for up to 20 robots, else the square of `gsv bench crowd`)")
      ->type_name("WORLD");
  command.add_option("--model", arguments->model, "model of the robots")
      ->type_name("MODEL")
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "print one JSON object");
  return arguments;
}

}  // namespace

void AddTypicalBench(const CommandLine& bench) {
  CLI::App* command = bench.app.add_subcommand(
      "typical",
      "Measure a typical load: robots with behaviours in separate processes, in real time");
  auto arguments = AddCommon(*command, {1, 2, 3, 4, 5});
  auto* behaviour =
      command->add_option("--behaviour", arguments->behaviour, "behaviour of the robots")
          ->type_name("NAME")
          ->capture_default_str();
  command
      ->add_flag("--exchange", arguments->exchange,
                 "use behaviours with one remote call per control cycle and without images")
      ->excludes(behaviour);
  command->add_flag("--in-process", arguments->in_process,
                    "run behaviours inside gsv, as fast as possible");
  command->callback([arguments, bench] {
    if (arguments->exchange) arguments->behaviour = kExchange;
    if (arguments->in_process) arguments->mode = simulation::Mode::kLockstep;
    bench.exit_code = Typical(*arguments);
  });
}

void AddLockstepBench(const CommandLine& bench) {
  CLI::App* command = bench.app.add_subcommand(
      "lockstep",
      "Compare behaviours with several calls and with one call per control cycle, in lockstep");
  auto arguments = AddCommon(*command, {5});
  arguments->mode = simulation::Mode::kLockstep;
  command->callback([arguments, bench] { bench.exit_code = Lockstep(*arguments); });
}

}  // namespace gsv::app
