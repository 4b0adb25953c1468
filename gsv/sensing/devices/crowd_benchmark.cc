// Measures the speed of a crowd's sonars. Run it in a release build.
//
// Robots are on a walled square with 10 m² per robot. There is a box for every four robots, and
// each robot has eight sonars. All sonars are read at one instant, then the robots move, and this
// repeats. A measured time is the time for one instant: to prepare the scene and to cast all rays.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include "gsv/base/random.h"
#include "gsv/base/thread_team.h"
#include "gsv/sensing/devices/sonar.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr int kSonars = 8;
constexpr double kStep = 0.05;  // simulated time between instants, s

std::shared_ptr<model::Model> CrowdRobot(const geometry::Shape& shape) {
  auto robot = testing::ModelOf(shape);
  robot->links[0].collisions[0].link_from_collision.position = {0, 0, 0.15};
  for (int i = 0; i < kSonars; ++i) {
    const double a = 2 * std::numbers::pi * i / kSonars;
    model::SensorDescription sonar;
    sonar.name = "sonar" + std::to_string(i);
    sonar.type = "sonar";
    sonar.link_from_sensor = geometry::PlanarPose(0.18 * std::cos(a), 0.18 * std::sin(a), 0.15, a);
    robot->sensors.push_back(sonar);
  }
  return robot;
}

class Crowd {
 public:
  Crowd(int robots, const geometry::Shape& shape)
      : half_(std::sqrt(10.0 * robots) / 2), noise_(1, 2, 3) {
    std::vector<testing::Placed> bodies;
    bodies.push_back({"ground", testing::ModelOf(geometry::Plane{}), {}, true});
    for (int i = 0; i < 4; ++i) {
      const double a = std::numbers::pi / 2 * i;
      bodies.push_back(
          {"wall" + std::to_string(i), testing::ModelOf(geometry::Box{{0.2, 2 * half_, 1}}),
           geometry::PlanarPose(half_ * std::cos(a), half_ * std::sin(a), 0.5, a), true});
    }
    for (int i = 0; i < robots / 4; ++i) {
      bodies.push_back({"box" + std::to_string(i), testing::ModelOf(geometry::Box{{1, 1, 1}}),
                        SomePlace(0.5), true});
    }
    const auto robot = CrowdRobot(shape);
    for (int i = 0; i < robots; ++i) {
      bodies.push_back({"robot" + std::to_string(i), robot, SomePlace(0), false});
    }
    snapshot_ = testing::MakeSnapshot(bodies);
    for (int i = 0; i < static_cast<int>(snapshot_->layout->bodies.size()); ++i) {
      if (!snapshot_->layout->bodies[i].is_static()) robots_.push_back(i);
    }
  }

  const std::shared_ptr<world::Snapshot>& snapshot() const { return snapshot_; }
  const std::vector<int>& robots() const { return robots_; }
  const model::Model& model() const { return *snapshot_->layout->bodies[robots_[0]].model; }

  // Each robot drives forward at 0.5 m/s. It turns about if it would leave the square.
  void Move() {
    auto moved = std::make_shared<world::Snapshot>(*snapshot_);
    ++moved->state.step;
    for (const int robot : robots_) {
      Pose& pose = moved->state.bodies[robot].world_from_model;
      pose = pose * geometry::PlanarPose(0.5 * kStep, 0, 0, 0.02);
      if (std::max(std::abs(pose.position.x), std::abs(pose.position.y)) > half_ - 0.5) {
        pose.position *= (half_ - 0.6) / (half_ - 0.5);
        pose = pose * geometry::PlanarPose(0, 0, 0, std::numbers::pi / 2);
      }
    }
    snapshot_ = std::move(moved);
  }

 private:
  Pose SomePlace(double z) {
    const auto within = [&](double extent) { return extent * (2 * noise_.Uniform() - 1); };
    const double x = within(half_ - 0.6), y = within(half_ - 0.6);
    return geometry::PlanarPose(x, y, z, within(std::numbers::pi));
  }

  double half_;
  base::Noise noise_;
  std::shared_ptr<world::Snapshot> snapshot_;
  std::vector<int> robots_;
};

geometry::Shape RobotShape(int kind) {
  if (kind == 1) return geometry::Box{{0.35, 0.3, 0.3}};
  return geometry::Cylinder{0.175, 0.3};
}

// The processor time of all threads, in seconds.
double ProcessorTime() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Calls `read` once per instant; the robots move between instants. Reports the mean time of an
// instant. Also reports the time of the fastest instant and the minimum processor time, because
// other programs may run on the machine.
template <class Read>
void RunCrowd(benchmark::State& bench, Crowd& crowd, const Read& read) {
  using Clock = std::chrono::steady_clock;
  double quickest = 1e9, least = 1e9;
  for (auto _ : bench) {
    crowd.Move();
    const double processor_begin = ProcessorTime();
    const auto begin = Clock::now();
    read();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    least = std::min(least, ProcessorTime() - processor_begin);
    quickest = std::min(quickest, seconds);
    bench.SetIterationTime(seconds);
  }
  const auto rays = static_cast<double>(kSonars * crowd.robots().size());
  bench.counters["rays/s"] = rays / quickest;
  bench.counters["quickest_us"] = quickest * 1e6;
  bench.counters["processor_us"] = least * 1e6;
}

void CrowdRays(benchmark::State& bench) {
  Crowd crowd(static_cast<int>(bench.range(0)), RobotShape(static_cast<int>(bench.range(1))));
  RaySceneCache cache;
  cache.At(crowd.snapshot());
  RunCrowd(bench, crowd, [&] {
    const auto scene = cache.At(crowd.snapshot());
    for (const int robot : crowd.robots()) {
      const Pose& world_from_robot = crowd.snapshot()->state.bodies[robot].world_from_model;
      std::array<Ray, kSonars> rays;
      for (int i = 0; i < kSonars; ++i) {
        const Pose world_from_sonar = world_from_robot * crowd.model().sensors[i].link_from_sensor;
        rays[i] = {world_from_sonar.position, world_from_sonar.orientation * Vector3{1, 0, 0}, 5};
      }
      std::array<std::optional<Hit>, kSonars> hits;
      scene->Cast(rays, robot, hits);
      benchmark::DoNotOptimize(hits);
    }
  });
}
BENCHMARK(CrowdRays)
    ->ArgNames({"robots", "box"})
    ->ArgsProduct({{5, 100, 1000, 5000, 10000}, {0, 1}})
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();

void CrowdSonars(benchmark::State& bench) {
  Crowd crowd(static_cast<int>(bench.range(0)), RobotShape(static_cast<int>(bench.range(1))));
  std::vector<std::unique_ptr<Sensor>> sonars;
  for (const model::SensorDescription& description : crowd.model().sensors) {
    sonars.push_back(*SonarType().create(description));
  }
  base::ThreadTeam team(static_cast<int>(bench.range(2)));
  RaySceneCache cache;
  cache.At(crowd.snapshot());
  constexpr std::size_t kRobotsAtOnce = 32;
  RunCrowd(bench, crowd, [&] {
    const auto scene = cache.At(crowd.snapshot(), &team);
    team.ParallelFor(crowd.robots().size(), kRobotsAtOnce, [&](std::size_t begin, std::size_t end) {
      Sampling sampling(crowd.snapshot(), -1, 1, cache);
      for (std::size_t i = begin; i < end; ++i) {
        sampling.MoveTo(crowd.robots()[i]);
        sampling.ExpectRays(sonars.size());
        for (const auto& sonar : sonars) benchmark::DoNotOptimize(sonar->Sample(sampling));
      }
    });
  });
}
BENCHMARK(CrowdSonars)
    ->ArgNames({"robots", "box", "threads"})
    ->ArgsProduct({{5, 100, 1000, 5000, 10000}, {0, 1}, {1, 2}})
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();

}  // namespace
}  // namespace gsv::sensing
