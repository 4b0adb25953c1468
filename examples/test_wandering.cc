// A robotic application that tests the wander behaviour in a real world. It finds a simulator by a
// constraint at the broker, creates a simulation, and adds robots with behaviours. It runs 30
// simulated seconds in lockstep. Then it checks that every robot moved and that none hit anything.
//
//   gsv serve --broker REF &   gsv-wander --broker REF &
//   example-test-wandering --broker REF [--world FILE --robot MODEL …]
//
// Exits with 0 if the test passed, 1 if it failed, 5 if there is no result.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "sdk/application.h"

namespace {

using namespace gsv;

struct Options {
  std::string broker, world, model = "pebble", behaviour = "wander", constraint;
  std::vector<double> places{-2, -0.5, 1, 1};  // x, y of each robot
  double seconds = 30, least_distance = 1;
  unsigned long seed = 1;
};

int PrintError(const base::Error& error) {
  std::fprintf(stderr, "%s\n", error.Sentence().c_str());
  return 5;
}

base::Result<SimulationState> Run(const Options& options) {
  auto application = Application::Connect(options.broker);
  if (!application) return base::Fail(application.error());
  auto simulation = (*application)
                        ->Create({.world = options.world, .lockstep = true, .seed = options.seed},
                                 options.constraint);
  if (!simulation) return base::Fail(simulation.error());
  for (std::size_t i = 0; i + 1 < options.places.size(); i += 2) {
    auto name = (*simulation)
                    ->AddRobot({.model = options.model,
                                .x = options.places[i],
                                .y = options.places[i + 1],
                                .behaviour = options.behaviour});
    if (!name) return base::Fail(name.error());
  }
  if (auto ok = (*simulation)->RunUntil(base::FromSeconds(options.seconds)); !ok)
    return base::Fail(ok.error());
  auto state = (*simulation)->State();
  if (auto hash = (*simulation)->StateHash()) std::printf("state %s\n", hash->c_str());
  return state;
}

bool Judge(const SimulationState& state, const Options& options) {
  bool good = !state.robots.empty();
  for (const RobotState& robot : state.robots) {
    const bool moved = robot.distance >= options.least_distance;
    const bool clean = robot.collisions == 0;
    std::printf("%s %s: %.2f m, %llu collisions\n", moved && clean ? "ok  " : "FAIL",
                robot.name.c_str(), robot.distance,
                static_cast<unsigned long long>(robot.collisions));
    good = good && moved && clean;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Tests a behaviour in a simulated world.");
  app.add_option("--broker", options.broker)->envname("GSV_BROKER")->required();
  app.add_option("--constraint", options.constraint,
                 "constraint over the properties of the simulator's offer");
  app.add_option("--world", options.world, "without it: the simulator's default");
  app.add_option("--robot", options.model)->capture_default_str();
  app.add_option("--places", options.places, "x and y of each robot, in metres");
  app.add_option("--behaviour", options.behaviour)->capture_default_str();
  app.add_option("--seconds", options.seconds)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const auto state = Run(options);
  if (!state) return PrintError(state.error());
  const bool good = Judge(*state, options);
  std::printf("verdict: %s\n", good ? "passed" : "failed");
  return good ? 0 : 1;
}
