#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/bench/bench.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/scenes/moving_scene.h"
#include "gsv/base/thread_team.h"

namespace gsv::app {
namespace {

using Stopwatch = std::chrono::steady_clock;
using Readings = std::vector<sensing::Reading>;

// height of the scanner above the robot's origin, so that the robot's own body blocks no rays
constexpr double kScannerHeight = 0.4;  // in m

struct LidarArguments {
  int rays = 360;
  double range = 10;  // in m
  int threads = 0;
  MovingSceneOptions scene;
  double duration = 5;  // simulated time, s
  bool json = false;
};

// Fails for empty scans, for scans that are equal to earlier scans, and for robots that do not
// move.
class ScanCheck {
 public:
  base::Status Check(const world::Snapshot& snapshot, const std::vector<std::string>& robots,
                     const Readings& scans) {
    std::size_t moved = 0;
    std::vector<geometry::Pose> poses;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const auto body = static_cast<std::size_t>(snapshot.layout->Find(robots[i]));
      poses.push_back(snapshot.state.bodies[body].world_from_model);
      const auto hits = std::count_if(scans[i].values.begin(), scans[i].values.end(),
                                      [](double range) { return std::isfinite(range); });
      if (hits * 10 < static_cast<std::ptrdiff_t>(scans[i].values.size()))
        return Fail("fewer than 10 % of a scan's rays hit something");
      if (i > 0 && scans[i].values == scans[i - 1].values)
        return Fail("two lidars have equal scans");
      const bool has_moved = i < last_.size() && !(poses[i] == poses_[i]);
      moved += has_moved;
      if (has_moved && last_[i].values == scans[i].values)
        return Fail("a moving lidar's scan equals the previous one");
    }
    if (!last_.empty() && 2 * moved < scans.size())
      return Fail("more than half of the robots do not move; use fewer robots");
    last_ = scans;
    poses_ = std::move(poses);
    return {};
  }

 private:
  static base::Status Fail(const std::string& what) {
    return base::Fail(base::ErrorCode::kUnavailable, what, "bench lidar");
  }
  Readings last_;
  std::vector<geometry::Pose> poses_;  // earlier poses of the same robots
};

struct ScanFigures {
  std::uint64_t triangles = 0;
  Solids solids;
  std::int64_t scans = 0, rays = 0;
  double wall = 0, processor = 0;  // time of all readings and of building the ray scenes, s
  double least_processor = 1e9;    // smallest processor time for all robots at one snapshot, s
  std::vector<double> instants;    // wall-clock times for all robots at one snapshot, ms
};

base::Result<std::unique_ptr<sensing::Sensor>> MakeLidar(const simulation::Simulation& simulation,
                                                         const LidarArguments& arguments) {
  model::SensorDescription description;
  description.name = "scanner";
  description.type = "lidar";
  description.link_from_sensor.position.z = kScannerHeight;
  description.parameters = {{"scan.horizontal.samples", static_cast<double>(arguments.rays)},
                            {"range.max", arguments.range}};
  return simulation.sensor_types().Find("lidar")->create(description);
}

// Takes the readings of all robots at one snapshot, in the same way as the behaviours' `exchange`
// calls.
class Scanning {
 public:
  Scanning(const sensing::Sensor& lidar, std::vector<std::string> robots, base::ThreadTeam& team)
      : lidar_(lidar), robots_(std::move(robots)), team_(team), readings_(robots_.size()) {}

  const Readings& Scan(const std::shared_ptr<const world::Snapshot>& snapshot) {
    // keeps the scene alive until all robots have read
    const auto scene = rays_.At(snapshot, &team_);
    team_.ParallelFor(robots_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const sensing::Sampling sampling(snapshot, snapshot->layout->Find(robots_[i]), 1, rays_);
        readings_[i] = *lidar_.Sample(sampling);
      }
    });
    return readings_;
  }

 private:
  const sensing::Sensor& lidar_;
  const std::vector<std::string> robots_;
  base::ThreadTeam& team_;
  sensing::RaySceneCache rays_;
  Readings readings_;
};

base::Result<std::shared_ptr<const world::Snapshot>> NextSnapshot(
    simulation::Simulation& simulation, int steps) {
  if (auto ok = simulation.Step(steps); !ok) return base::Fail(ok.error());
  const auto phase = simulation.WaitForPhase(
      {simulation::Phase::kPaused, simulation::Phase::kFailed}, std::chrono::seconds(10));
  if (phase == simulation::Phase::kPaused) return simulation.snapshot();
  return base::Fail(base::ErrorCode::kTimeout, "the simulation does not advance", "bench lidar");
}

base::Result<ScanFigures> MeasureScans(const LidarArguments& arguments) {
  auto scene = MovingScene::Create(arguments.scene);
  if (!scene) return base::Fail(scene.error());
  simulation::Simulation& simulation = *scene->simulation;
  const auto lidar = MakeLidar(simulation, arguments);
  if (!lidar) return base::Fail(lidar.error());
  base::ThreadTeam team(arguments.threads);
  Scanning scanning(**lidar, scene->robots, team);
  ScanFigures figures;
  figures.triangles = TrianglesIn(*simulation.snapshot()->layout);
  figures.solids = SolidsIn(*simulation.snapshot()->layout);
  ScanCheck check;
  // The first steps are not measured, because they include work that is done once for a world, and
  // the robots accelerate.
  constexpr int kStepsToBegin = 100;
  for (int round = -1; figures.wall < arguments.duration; ++round) {
    const auto snapshot = NextSnapshot(simulation, round < 0 ? kStepsToBegin : 1);
    if (!snapshot) return base::Fail(snapshot.error());
    const double processor_start = ProcessorTime();
    const auto start = Stopwatch::now();
    const Readings& scans = scanning.Scan(*snapshot);
    const auto took = Stopwatch::now() - start;
    const double processor = ProcessorTime() - processor_start;
    if (auto ok = check.Check(**snapshot, scene->robots, scans); !ok) return base::Fail(ok.error());
    if (round < 0) continue;
    figures.wall += Seconds(took);
    figures.processor += processor;
    figures.least_processor = std::min(figures.least_processor, processor);
    figures.instants.push_back(Milliseconds(took));
    figures.scans += static_cast<std::int64_t>(scans.size());
    for (const sensing::Reading& scan : scans) {
      figures.rays += static_cast<std::int64_t>(scan.values.size());
    }
  }
  return figures;
}

int RunLidarBench(LidarArguments arguments) {
  if (arguments.threads == 0) arguments.threads = base::ThreadTeam::DefaultThreads();
  const auto figures = MeasureScans(arguments);
  if (!figures) return PrintError(figures.error());
  const nlohmann::ordered_json json{
      {"world", arguments.scene.world},
      {"robots", arguments.scene.robots},
      {"rays", arguments.rays},
      {"range_m", arguments.range},
      {"triangles", figures->triangles},
      {"solid_triangles", figures->solids.triangles},
      {"solid_shapes", figures->solids.shapes},
      {"threads", arguments.threads},
      {"scans", figures->scans},
      {"scans_per_s", static_cast<double>(figures->scans) / figures->wall},
      {"rays_per_s", static_cast<double>(figures->rays) / figures->wall},
      {"cpu_ns_a_ray", 1e9 * figures->processor / static_cast<double>(figures->rays)},
      {"least_cpu_ns_a_ray",
       1e9 * figures->least_processor / (arguments.scene.robots * arguments.rays)},
      {"instant_p50_ms", QuantileOf(figures->instants, 0.5)},
      {"instant_p99_ms", QuantileOf(figures->instants, 0.99)}};
  PrintFigures(json, arguments.json);
  return kOk;
}

}  // namespace

void AddLidarBench(const CommandLine& bench) {
  CLI::App* command = bench.app.add_subcommand(
      "lidar", "Measure lidar scans of driving robots: scans and rays per second, time per ray");
  auto arguments = std::make_shared<LidarArguments>();
  arguments->scene.mode = simulation::Mode::kLockstep;
  command->add_option("--rays", arguments->rays, "rays per scan, in a full circle")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(8, 100'000));
  command->add_option("--range", arguments->range, "range of the lidar")
      ->type_name("METRES")
      ->capture_default_str()
      ->check(Between(0.1, 1000.0));
  command->add_option("--robots", arguments->scene.robots, "number of robots")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(1, 10'000));
  command
      ->add_option("--world", arguments->scene.world,
                   "world, or \"square\" for the world of `gsv bench crowd`")
      ->type_name("WORLD")
      ->capture_default_str();
  command->add_option("--model", arguments->scene.model, "model of the robots")
      ->type_name("MODEL")
      ->capture_default_str();
  command->add_flag("--meshes", arguments->scene.collide_with_visuals,
                    "intersect rays with visuals of static bodies instead of collision shapes\n"
                    "This option has no effect with --world square.");
  command
      ->add_option("--threads", arguments->threads, "threads for the scans; 0: one per processor")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(0, 64));
  command->add_option("--duration", arguments->duration, "wall-clock time of the measurement")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(Between(0.1, 3600.0));
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments, bench] { bench.exit_code = RunLidarBench(*arguments); });
}

}  // namespace gsv::app
