// Measures the speed of rays and scenes: run it in a release build.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "gsv/base/random.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

// A hilly surface, 30 m wide, of 2 side² triangles.
geometry::Mesh Sheet(int side) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  const auto n = static_cast<std::uint32_t>(side);
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t k = 0; k <= n; ++k) {
      const double x = 30.0 * i / n - 15, y = 30.0 * k / n - 15;
      mesh->positions.push_back({x, y, 0.2 * std::sin(x) * std::cos(y) - 0.3});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = i * (n + 1) + k, b = a + n + 1;
      mesh->triangles.push_back({a, b, b + 1});
      mesh->triangles.push_back({a, b + 1, a + 1});
    }
  }
  return {mesh, {1, 1, 1}};
}

// Robots with a body, a mast and two turning wheels, walls, and a ground of 80,000 triangles.
std::shared_ptr<world::Snapshot> MakeWorld(int robots) {
  base::Noise noise(1, 2, 3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  auto robot = testing::ModelOf(geometry::Cylinder{0.2, 0.4});
  robot->links[0].collisions.push_back(
      testing::ModelOf(geometry::Box{{0.1, 0.1, 0.8}})->links[0].collisions[0]);
  for (int i = 0; i < 2; ++i) {
    robot->links.push_back(testing::ModelOf(geometry::Cylinder{0.08, 0.04})->links[0]);
    robot->links.back().model_from_link.position = {0, i ? 0.2 : -0.2, -0.12};
    model::Joint joint;
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0, joint.child = i + 1;
    joint.axis = {0, 1, 0};
    robot->joints.push_back(joint);
  }
  std::vector<testing::Placed> bodies;
  bodies.push_back({"ground", testing::ModelOf(Sheet(200)), {}, true});
  for (int i = 0; i < 200; ++i) {
    bodies.push_back({"wall" + std::to_string(i), testing::ModelOf(geometry::Box{{1.5, 0.1, 2}}),
                      geometry::PlanarPose(uniform(-15, 15), uniform(-15, 15), 1, uniform(-3, 3)),
                      true});
  }
  for (int i = 0; i < robots; ++i) {
    bodies.push_back({"robot" + std::to_string(i), robot,
                      geometry::PlanarPose(uniform(-15, 15), uniform(-15, 15), 0.3, uniform(-3, 3)),
                      false});
  }
  return testing::MakeSnapshot(bodies);
}

void Move(benchmark::State& bench) {
  const auto snapshot = MakeWorld(static_cast<int>(bench.range(0)));
  RaySceneCache cache;
  cache.At(snapshot);
  for (auto _ : bench) {
    bench.PauseTiming();
    const auto moved = std::make_shared<world::Snapshot>(*snapshot);
    bench.ResumeTiming();
    benchmark::DoNotOptimize(cache.At(moved));
  }
}
BENCHMARK(Move)->Arg(10)->Arg(1000)->Unit(benchmark::kMicrosecond);

void SingleRays(benchmark::State& bench) {
  const auto snapshot = MakeWorld(static_cast<int>(bench.range(0)));
  RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  base::Noise noise(1, 2, 3);
  std::vector<Ray> rays(4096);
  for (Ray& ray : rays) {
    const double a = 2 * std::numbers::pi * noise.Uniform();
    ray = {{30 * noise.Uniform() - 15, 30 * noise.Uniform() - 15, 0.35},
           {std::cos(a), std::sin(a), 0},
           5};
  }
  std::size_t i = 0;
  for (auto _ : bench) benchmark::DoNotOptimize(scene->Cast(rays[i++ & 4095], -1));
  bench.SetItemsProcessed(bench.iterations());
}
BENCHMARK(SingleRays)->Arg(10)->Arg(1000);

void Scans(benchmark::State& bench) {
  const auto snapshot = MakeWorld(static_cast<int>(bench.range(0)));
  RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  std::vector<Ray> rays(360);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double a = 2 * std::numbers::pi * static_cast<double>(i) / 360;
    rays[i] = {{0, 0, 0.35}, {std::cos(a), std::sin(a), 0}, 10};
  }
  std::vector<std::optional<Hit>> hits(rays.size());
  for (auto _ : bench) scene->Cast(rays, -1, hits);
  bench.SetItemsProcessed(bench.iterations() * 360);
}
BENCHMARK(Scans)->Arg(10)->Arg(1000);

}  // namespace
}  // namespace gsv::sensing
