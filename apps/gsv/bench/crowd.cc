#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/bench/bench.h"
#include "apps/gsv/bench/crowd_check.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/scenes/crowd_scenario.h"
#include "gsv/base/thread_team.h"
#include "gsv/health/health_tracker.h"
#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/sensing/devices/built_in.h"

namespace gsv::app {
namespace {

using WallClock = std::chrono::steady_clock;
using simulation::Phase;

struct CrowdArguments {
  std::vector<int> robots{100};
  double duration = 60;
  std::uint64_t seed = 1;
  int threads = 0;
  bool verify = false, health = false, json = false;
};

struct CrowdRow {
  int robots = 0, threads = 0;
  double load = 0;       // processor load, s
  double wall = 0;       // wall-clock time of the steps, s
  double rss = 0;        // memory, MiB
  double simulated = 0;  // simulated time, s
  std::uint64_t readings = 0, collisions = 0;
  std::int64_t steps = 0;
  std::string state_hash;
  std::shared_ptr<CrowdCheck> check;  // null without --verify
  std::uint64_t health_reports = 0;
};

// Returns the current resident memory of this process, in MiB. The maximum resident memory is not
// used, because this process has also measured the earlier rows of the table.
double ResidentMebibytes() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident = 0;
  statm >> pages >> resident;
  return resident * 4096 / (1 << 20);
}

// Controls a robot of the crowd, and passes the robot's readings to the check by brute force.
class CheckedController final : public CrowdController {
 public:
  CheckedController(std::shared_ptr<CrowdCheck> check,
                    std::weak_ptr<simulation::Simulation> simulation)
      : check_(std::move(check)), simulation_(std::move(simulation)) {}

  base::Status Init(Robot& robot) override {
    robot_ = robot.name();
    return CrowdController::Init(robot);
  }
  DriveCommand Control(const std::vector<Reading>& readings) override {
    std::vector<double> ranges;
    ranges.reserve(readings.size());
    for (const Reading& reading : readings) ranges.push_back(reading.values.at(0));
    if (const auto simulation = simulation_.lock()) {
      check_->TakeReadings(*simulation->snapshot(), robot_, ranges);
    }
    return CrowdController::Control(readings);
  }

 private:
  const std::shared_ptr<CrowdCheck> check_;
  const std::weak_ptr<simulation::Simulation> simulation_;
  std::string robot_;
};

base::Result<std::shared_ptr<simulation::Simulation>> LoadCrowd(const CrowdArguments& arguments,
                                                                CrowdRow& row) {
  simulation::Specification specification;
  specification.name = "crowd";
  specification.world = CrowdWorld(row.robots, arguments.seed);
  specification.mode = simulation::Mode::kLockstep;
  specification.seed = arguments.seed;
  specification.duration = base::FromSeconds(arguments.duration);
  specification.threads = row.threads;
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  auto simulation = simulation::Simulation::Create(specification, sensors);
  if (!simulation) return simulation;
  if (arguments.verify) {
    row.check = std::make_shared<CrowdCheck>();
    (*simulation)->AddObserver(row.check);
  }
  const BehaviourFactory factory =
      [check = row.check, weak = std::weak_ptr(*simulation)]() -> std::unique_ptr<Behaviour> {
    if (check != nullptr) return std::make_unique<CheckedController>(check, weak);
    return std::make_unique<CrowdController>();
  };
  std::vector<simulation::RobotSpecification> robots = CrowdRobots(row.robots, arguments.seed);
  for (simulation::RobotSpecification& robot : robots) {
    robot.behaviour = std::make_shared<hosting::HostedBehaviour>("crowd", factory);
  }
  const auto names = (*simulation)->AddRobots(std::move(robots));
  if (!names) return base::Fail(names.error());
  return simulation;
}

// Waits until the run has ended. With --health, it also computes the health of all robots, as often
// as gsv does for a viewer that subscribes to the health.
void AwaitEnd(simulation::Simulation& simulation, const CrowdArguments& arguments, CrowdRow& row) {
  const std::vector<Phase> ends{Phase::kFinished, Phase::kFailed};
  if (arguments.health) {
    health::HealthTracker tracker;
    for (Phase phase = Phase::kRunning; std::count(ends.begin(), ends.end(), phase) == 0;) {
      phase = simulation.WaitForPhase(ends, std::chrono::milliseconds(500));
      (void)tracker.Update(simulation.status(), simulation.specification().stuck_after,
                           health::SensorsOf(simulation));
      ++row.health_reports;
    }
  }
  simulation.WaitForPhase(ends, std::chrono::hours(24));
}

base::Result<CrowdRow> RunCrowd(const CrowdArguments& arguments, int robots) {
  CrowdRow row;
  row.robots = robots;
  row.threads = arguments.threads > 0 ? arguments.threads : base::ThreadTeam::DefaultThreads();
  const auto start = WallClock::now();
  const auto simulation = LoadCrowd(arguments, row);
  if (!simulation) return base::Fail(simulation.error());
  row.load = Seconds(WallClock::now() - start);
  if (auto ok = (*simulation)->Start(); !ok) return base::Fail(ok.error());
  AwaitEnd(**simulation, arguments, row);
  row.rss = ResidentMebibytes();
  const simulation::SimulationStatus status = (*simulation)->status();
  if (status.phase != Phase::kFinished) {
    return base::Fail(base::ErrorCode::kBehaviour, status.failure, "crowd");
  }
  row.wall = Seconds(status.wall_time);
  row.simulated = base::ToSeconds(status.time);
  row.steps = status.step;
  for (const simulation::RobotStatus& robot : status.robots) {
    row.collisions += robot.collisions;
    for (const auto& [type, count] : robot.readings) row.readings += count;
  }
  row.state_hash = (*simulation)->state_hash();
  return row;
}

nlohmann::ordered_json ToJson(const CrowdRow& row) {
  nlohmann::ordered_json json{
      {"robots", row.robots},         {"real_time_factor", row.simulated / row.wall},
      {"load_s", row.load},           {"rss_mb", row.rss},
      {"steps", row.steps},           {"readings", row.readings},
      {"collisions", row.collisions}, {"threads", row.threads},
      {"state_hash", row.state_hash}};
  if (row.health_reports > 0) json["health_reports"] = row.health_reports;
  if (row.check != nullptr) {
    json["verified"] = {{"readings", row.check->readings_checked()},
                        {"pairs", row.check->pairs_checked()},
                        {"mismatches", row.check->mismatches()},
                        {"first_mismatch", row.check->first_mismatch()}};
  }
  return json;
}

// Returns the slope of log(time per step) against log(robots), by least squares. A slope of 1 is
// linear growth.
double GrowthExponent(const std::vector<CrowdRow>& rows) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const CrowdRow& row : rows) {
    const double x = std::log(row.robots);
    const double y = std::log(row.wall / static_cast<double>(row.steps));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

int Crowd(const CrowdArguments& arguments) {
  std::vector<CrowdRow> rows;
  if (!arguments.json) {
    std::printf(
        "robots  threads  real time   load     rss     steps    readings  collisions  hash\n");
    std::printf("                         x      s     MiB\n");
  }
  bool is_right = true;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const int robots : arguments.robots) {
    auto row = RunCrowd(arguments, robots);
    if (!row) return PrintError(row.error());
    json.push_back(ToJson(*row));
    if (!arguments.json) {
      std::printf("%6d  %7d  %9.2f  %5.2f  %6.0f  %8lld  %10llu  %10llu  %s\n", row->robots,
                  row->threads, row->simulated / row->wall, row->load, row->rss,
                  static_cast<long long>(row->steps),
                  static_cast<unsigned long long>(row->readings),
                  static_cast<unsigned long long>(row->collisions), row->state_hash.c_str());
      std::fflush(stdout);
    }
    if (row->check != nullptr && row->check->mismatches() > 0) {
      is_right = false;
      std::fprintf(stderr, "%llu mismatches; the first: %s\n",
                   static_cast<unsigned long long>(row->check->mismatches()),
                   row->check->first_mismatch().c_str());
    }
    rows.push_back(*std::move(row));
  }
  nlohmann::ordered_json result{{"rows", json}};
  if (rows.size() > 1) result["growth_exponent"] = GrowthExponent(rows);
  if (arguments.json) {
    std::printf("%s\n", result.dump().c_str());
  } else if (rows.size() > 1) {
    std::printf("the time of a step grows with the number of robots to the power of %.2f\n",
                GrowthExponent(rows));
  }
  return is_right ? kOk : kAssertionFailed;
}

}  // namespace

void AddCrowdBench(const CommandLine& bench) {
  CLI::App* command = bench.app.add_subcommand(
      "crowd", "Measure many wandering robots in a walled square, in process and in lockstep");
  auto arguments = std::make_shared<CrowdArguments>();
  command->add_option("--robots", arguments->robots, "numbers of robots, one row for each")
      ->type_name("N,...")
      ->delimiter(',')
      ->capture_default_str()
      ->check(Between(1, 100'000));
  command->add_option("--duration", arguments->duration, "simulated time per row")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(Between(0.1, 1e6));
  command->add_option("--seed", arguments->seed, "seed of all noise")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--threads", arguments->threads, "threads; 0: one per processor")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(0, 256));
  command->add_flag(
      "--verify", arguments->verify,
      "recompute overlaps and 1 % of the readings by brute force; exit code 1 if a result differs");
  command->add_flag(
      "--health", arguments->health,
      "compute the health of all robots twice a second, as gsv does for a viewer that shows it");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments, bench] { bench.exit_code = Crowd(*arguments); });
}

}  // namespace gsv::app
