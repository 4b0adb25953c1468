#include <chrono>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/bench/bench.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/scenes/rigid_scenario.h"
#include "gsv/base/named.h"
#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/solver_count.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {
namespace {

using simulation::Phase;

struct RigidArguments {
  std::string scene = "rovers";
  int bodies = 10;
  double duration = 3;  // s
  int threads = 0;
  bool json = false;
};

constexpr base::Named<RigidScenario> kScenes[] = {{"rovers", RigidScenario::kRovers},
                                                  {"boxes", RigidScenario::kBoxes},
                                                  {"terrain", RigidScenario::kTerrain},
                                                  {"arms", RigidScenario::kArms}};

base::Result<std::shared_ptr<simulation::Simulation>> RunRigid(const RigidArguments& arguments) {
  simulation::Specification specification;
  specification.name = "rigid";
  specification.world = RigidWorldOf(*base::FindNamed(kScenes, arguments.scene), arguments.bodies);
  specification.mode = simulation::Mode::kLockstep;
  specification.duration = base::FromSeconds(arguments.duration);
  specification.threads = arguments.threads;
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  auto simulation = simulation::Simulation::Create(specification, sensors);
  if (!simulation) return simulation;
  if (auto ok = (*simulation)->Start(); !ok) return base::Fail(ok.error());
  constexpr auto kMaxRunTime = std::chrono::hours(24);
  if ((*simulation)->WaitForPhase({Phase::kFinished, Phase::kFailed}, kMaxRunTime) ==
      Phase::kFailed) {
    return base::Fail(base::ErrorCode::kUnavailable, (*simulation)->status().failure, "rigid");
  }
  return simulation;
}

int Rigid(RigidArguments arguments) {
  if (arguments.threads == 0) arguments.threads = base::ThreadTeam::DefaultThreads();
  const double processor_start = ProcessorTime();
  const auto simulation = RunRigid(arguments);
  if (!simulation) return PrintError(simulation.error());
  const double processor = ProcessorTime() - processor_start;
  const simulation::SimulationStatus status = (*simulation)->status();
  const auto steps = static_cast<double>(status.step);
  std::size_t points = 0;
  const auto snapshot = (*simulation)->snapshot();
  for (const world::Contact& contact : snapshot->contacts) points += contact.points.size();
  const auto body = static_cast<std::size_t>(snapshot->layout->Find(kFirstRigidBody));
  // The position of the first body is printed. The base of an arm does not move, so the position of
  // the arm's last link is printed instead.
  geometry::Pose first = snapshot->state.bodies[body].world_from_model;
  if (arguments.scene == "arms") {
    first = world::LinkPoses(*snapshot, static_cast<int>(body)).back();
  }
  const nlohmann::ordered_json json{
      {"scene", arguments.scene},
      {"bodies", arguments.bodies},
      {"threads", arguments.threads},
      {"steps", status.step},
      {"ms_per_step", Milliseconds(status.wall_time) / steps},
      {"cpu_ms_per_step", 1e3 * processor / steps},
      {"real_time_factor", base::ToSeconds(status.time) / Seconds(status.wall_time)},
      {"contacts", points},
      {"iterations_per_step", static_cast<double>(dynamics::SolverIterations()) / steps},
      {"first_m", {first.position.x, first.position.y, first.position.z}},
      {"state_hash", (*simulation)->state_hash()}};
  PrintFigures(json, arguments.json);
  return kOk;
}

}  // namespace

void AddRigidBench(const CommandLine& bench) {
  CLI::App* command = bench.app.add_subcommand(
      "rigid",
      "Measure rigid-body dynamics of rovers, a heap of boxes, rovers on terrain, or arms");
  auto arguments = std::make_shared<RigidArguments>();
  command->add_option("--scene", arguments->scene, "scene")
      ->type_name("rovers|boxes|terrain|arms")
      ->capture_default_str()
      ->check(OneOf({"rovers", "boxes", "terrain", "arms"}));
  command->add_option("--bodies", arguments->bodies, "number of rovers, boxes or arms")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(1, 10'000));
  command->add_option("--duration", arguments->duration, "simulated time, with steps of 1 ms")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(Between(0.01, 1e6));
  command->add_option("--threads", arguments->threads, "threads; 0: one per processor")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(0, 256));
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments, bench] { bench.exit_code = Rigid(*arguments); });
}

}  // namespace gsv::app
