// Measures the time of a step of the planar mover. Run it in a release build.
//
// Step: robots wander over a square with 4 m² per robot and one wall for every four robots. Half of
// the robots are round, half are boxes with two wheels. Many of them push against an obstacle.
// Crowd: see test_crowd.h. A few per cent of the robots touch an obstacle.

#include <benchmark/benchmark.h>

#include "gsv/base/check.h"
#include "gsv/base/random.h"
#include "gsv/dynamics/testing/test_crowd.h"
#include "gsv/dynamics/testing/test_world.h"
#include "gsv/dynamics/world_engine.h"

namespace gsv::dynamics {
namespace {

std::shared_ptr<model::Model> WheeledBox() {
  auto robot = testing::BoxRobot(0.4, 0.3);
  for (const double side : {1.0, -1.0}) {
    model::Joint joint;
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = static_cast<int>(robot->links.size());
    joint.model_from_joint.position = {0, 0.17 * side, 0.08};
    joint.axis = {0, 1, 0};
    robot->links.push_back(testing::LinkOf(
        geometry::Cylinder{0.08, 0.04},
        {{0, 0.17 * side, 0.08}, geometry::FromAxisAngle({1, 0, 0}, 1.5707963267948966)}));
    (side > 0 ? robot->drive->left_wheels : robot->drive->right_wheels)
        .push_back(static_cast<int>(robot->joints.size()));
    robot->joints.push_back(joint);
  }
  return robot;
}

void Step(benchmark::State& bench) {
  const int robots = static_cast<int>(bench.range(0));
  const double half_side = std::sqrt(4.0 * robots) / 2;
  base::Noise noise(1, 2, 3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  testing::TestWorld world(MakeWorldEngine());
  const auto disc = testing::DiscRobot(0.2);
  const auto box = WheeledBox();
  const int columns = static_cast<int>(std::ceil(std::sqrt(robots)));
  for (int i = 0; i < robots; ++i) {
    const int column = i % columns, row = i / columns;
    world.AddRobot(
        "r" + std::to_string(i), i % 2 ? disc : box,
        geometry::PlanarPose(2.0 * column - half_side, 2.0 * row - half_side, 0, uniform(-3, 3)));
  }
  for (int i = 0; i < robots / 4; ++i) {
    world.AddBox("w" + std::to_string(i), {1.2, 0.1, 1},
                 std::floor(uniform(-half_side, half_side) / 2) * 2 + 1,
                 std::floor(uniform(-half_side, half_side) / 2) * 2 + 1, 0, uniform(-3, 3));
  }
  GSV_CHECK(world.Start());
  std::size_t contacts = 0, steps = 0;
  for (auto _ : bench) {
    if (steps++ % 100 == 0) {
      bench.PauseTiming();
      for (const world::Body& body : world.layout().bodies) {
        if (!body.is_static()) world.Command(body.name, {uniform(-0.2, 1), 0, uniform(-1, 1)});
      }
      bench.ResumeTiming();
    }
    contacts += world.Step(0.01).size();
  }
  bench.counters["contacts"] = static_cast<double>(contacts) / static_cast<double>(steps);
}
BENCHMARK(Step)->Arg(5)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);

// Measures a step of the crowd of test_crowd.h, including the robots' decisions.
void Run(benchmark::State& bench, std::shared_ptr<const model::Model> robot) {
  const auto team = std::make_shared<base::ThreadTeam>(static_cast<int>(bench.range(1)));
  testing::Crowd crowd(static_cast<int>(bench.range(0)), std::move(robot), MakeWorldEngine(team));
  GSV_CHECK(crowd.Start());
  for (int i = 0; i < 500; ++i) crowd.Step();
  double in_contact = 0;
  std::size_t steps = 0;
  for (auto _ : bench) {
    crowd.Step();
    if (++steps % 64 == 0) in_contact += 64 * crowd.InContact();
  }
  bench.counters["in_contact"] = in_contact / static_cast<double>(steps);
}

void InAllSizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"robots", "threads"})->ArgsProduct({{5, 100, 1000, 10000}, {1, 2}});
  benchmark->UseRealTime()->Unit(benchmark::kMicrosecond);
}

void CrowdOfDiscs(benchmark::State& bench) { Run(bench, testing::DiscRobot(0.175)); }
BENCHMARK(CrowdOfDiscs)->Apply(InAllSizes);

void CrowdOfBoxes(benchmark::State& bench) { Run(bench, testing::BoxRobot(0.3, 0.2)); }
BENCHMARK(CrowdOfBoxes)->Apply(InAllSizes);

}  // namespace
}  // namespace gsv::dynamics
