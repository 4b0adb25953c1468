// Measures the speed of rendering: run it in a release build.
//
// A hundred robots are in a building of 20 by 20 m. The building has 25 rooms with a table each, a
// sun and four lamps. The cameras of some robots, with 320 by 240 pixels, take their images at one
// instant. Then all robots move, and this repeats. A measured time is the time for one instant:
// shadows, images and their readback.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include "gsv/base/check.h"
#include "gsv/base/random.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

using geometry::Box;
using geometry::PlanarPose;
using geometry::Pose;

constexpr int kRobots = 100;
constexpr int kRooms = 5;  // rooms along a side of the building
// side of a room, and half of the building's side, in m
constexpr double kRoom = 4, kHalf = kRooms * kRoom / 2;
constexpr double kStep = 0.05;  // simulated time between instants, in s

// A chequered texture, so that textures are as expensive as in realistic worlds.
std::shared_ptr<const model::Image> Tiles() {
  auto image = std::make_shared<model::Image>();
  image->width = image->height = 256;
  for (int i = 0; i < 256 * 256; ++i) {
    const std::uint8_t shade = ((i / 32 + i / 256 / 32) % 2 == 0) ? 230 : 200;
    image->pixels.insert(image->pixels.end(), {shade, shade, shade});
  }
  return image;
}

class Office {
 public:
  Office() : noise_(1, 2, 3) {
    AddLights();
    auto tiles = Matt(0.9, 0.9, 0.9);
    tiles.base_colour_map = Tiles();
    scene_.Add("floor", Box{{2 * kHalf, 2 * kHalf, 0.1}}, {{0, 0, -0.05}, {}}, tiles, true);
    for (int i = 0; i <= kRooms; ++i) {
      for (int k = 0; k < kRooms; ++k) AddWalls(i, k, tiles);
    }
    for (int i = 0; i < kRooms * kRooms; ++i) {
      scene_.Add("table" + std::to_string(i), Box{{1.2, 0.6, 0.7}}, SomePlace(0.35),
                 Matt(0.6, 0.4, 0.2));
    }
    for (int i = 0; i < kRobots; ++i) AddRobot("robot" + std::to_string(i), SomePlace(0));
    auto snapshot = scene_.Snapshot();
    for (int i = 0; i < kRobots; ++i) {
      robots_.push_back(snapshot->layout->Find("robot" + std::to_string(i)));
    }
    snapshot_ = std::move(snapshot);
  }

  std::shared_ptr<const world::Snapshot> snapshot() const { return snapshot_; }

  // Each robot drives at 0.5 m/s along a circle.
  void Move() {
    auto moved = std::make_shared<world::Snapshot>(*snapshot_);
    ++moved->state.step;
    for (const int robot : robots_) {
      Pose& pose = moved->state.bodies[robot].world_from_model;
      pose = pose * PlanarPose(0.5 * kStep, 0, 0, 1.0 * kStep);
    }
    snapshot_ = std::move(moved);
  }

  CameraView CameraOf(int robot) const {
    const Pose& pose = snapshot_->state.bodies[robots_[robot % kRobots]].world_from_model;
    return {pose * PlanarPose(0.3, 0, 1.0, 0), {320, 240, 1.047, 0.05, 50}};
  }

 private:
  void AddLights() {
    model::Light sun;
    sun.direction = geometry::Normalized(geometry::Vector3{0.42, 0.38, -0.82});
    scene_.description().lights = {sun};
    for (const double x : {-5.0, 5.0}) {
      for (const double y : {-5.0, 5.0}) {
        model::Light lamp;
        lamp.kind = model::Light::Kind::kPoint;
        lamp.world_from_light.position = {x, y, 2.3};
        lamp.range = 7;
        lamp.diffuse = {0.5, 0.46, 0.38, 1};
        scene_.description().lights.push_back(lamp);
      }
    }
  }

  // Adds two walls, one along x and one along y. Between each wall and the corner of the rooms
  // there is an opening of 1.4 m, the door.
  void AddWalls(int i, int k, const model::Material& material) {
    const double at = kRoom * i - kHalf, along = kRoom * (k + 0.5) - kHalf + 0.7;
    const std::string name = std::to_string(i) + "." + std::to_string(k);
    const Box wall{{kRoom - 1.4, 0.15, 2.5}};
    scene_.Add("x" + name, wall, PlanarPose(along, at, 1.25, 0), material, true);
    scene_.Add("y" + name, wall, PlanarPose(at, along, 1.25, std::numbers::pi / 2), material, true);
  }

  // A robot is a drum with a ring of bolts: like real robots, it has many small triangles.
  void AddRobot(const std::string& name, const Pose& pose) {
    scene_.Add(name, geometry::Cylinder{0.26, 0.9}, pose, Matt(0.7, 0.05, 0.05));
    model::Link& link = scene_.LinkOf(name);
    link.visuals[0].link_from_visual.position.z = 0.45;
    for (int i = 0; i < 24; ++i) {
      const double a = 2 * std::numbers::pi * i / 24;
      model::Visual bolt;
      bolt.shape = Box{{0.04, 0.04, 0.04}};
      bolt.materials = {Matt(0.8, 0.65, 0.3)};
      bolt.link_from_visual = PlanarPose(0.26 * std::cos(a), 0.26 * std::sin(a), 0.4, 0);
      link.visuals.push_back(bolt);
    }
  }

  Pose SomePlace(double z) {
    const auto within = [&](double extent) { return extent * (2 * noise_.Uniform() - 1); };
    const double x = within(kHalf - 0.5), y = within(kHalf - 0.5);
    return PlanarPose(x, y, z, within(std::numbers::pi));
  }

  TestScene scene_;
  base::Noise noise_;
  std::shared_ptr<const world::Snapshot> snapshot_;
  std::vector<int> robots_;
};

// The processor time of all threads, in seconds.
double ProcessorTime() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Reports the mean and the minimum processor time of an instant. The minimum hardly depends on
// other programs on the machine.
void Images(benchmark::State& bench) {
  const int cameras = static_cast<int>(bench.range(0));
  RendererOptions options;
  options.back_end = BackEnd::kRasteriser;
  const auto renderer = Renderer::Start(options);
  GSV_CHECK(renderer.has_value());
  Office office;
  int next = 0;
  const auto draw = [&] {
    office.Move();
    std::vector<CameraView> views;
    views.reserve(static_cast<std::size_t>(cameras));
    for (int i = 0; i < cameras; ++i) views.push_back(office.CameraOf(next++));
    const auto images = (*renderer)->Draw(office.snapshot(), views, std::chrono::minutes(1));
    GSV_CHECK(images.has_value());
  };
  // While the first images are rendered, everything is done that is needed once per world.
  for (int i = 0; i < 3; ++i) draw();
  double least = 1e9;
  for (auto _ : bench) {
    const double begin = ProcessorTime();
    draw();
    least = std::min(least, ProcessorTime() - begin);
  }
  bench.counters["pictures/s"] = benchmark::Counter(
      static_cast<double>(cameras * bench.iterations()), benchmark::Counter::kIsRate);
  bench.counters["processor_ms_a_picture"] = 1e3 * least / cameras;
}
BENCHMARK(Images)
    ->ArgName("cameras")
    ->Arg(1)
    ->Arg(10)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace gsv::rendering
