#include "apps/gsv/scenes/crowd_scenario.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gsv/base/random.h"

namespace gsv::app {
namespace {

using geometry::PlanarPose;

constexpr double kAreaPerRobot = 10;  // in m²
constexpr double kBoxSide = 1;        // in m
constexpr double kWallHeight = 1;     // in m
constexpr double kWallThickness = 0.2;

// A square grid. Each robot starts in its own cell. In both directions, every second corner
// inside the grid has a box.
struct Raster {
  explicit Raster(int robots)
      : columns(static_cast<int>(std::ceil(std::sqrt(robots)))),
        field(std::sqrt(kAreaPerRobot * robots) / columns) {}
  double Line(double number) const { return (number - columns / 2.0) * field; }
  double side() const { return columns * field; }

  int columns;
  double field;  // side of a cell, m
};

model::PlacedModel StandingBox(std::string name, const geometry::Vector3& size,
                               const geometry::Pose& pose) {
  auto model = std::make_shared<model::Model>();
  model->name = name;
  model->is_static = true;
  model->links.resize(1);
  model->links[0].name = "link";
  const geometry::Pose lifted{{0, 0, size.z / 2}, {}};
  model->links[0].collisions.push_back({"box", lifted, geometry::Box{size}, {}});
  return {std::move(name), std::move(model), pose, true};
}

std::shared_ptr<const model::Model> CrowdRobot() {
  auto robot = std::make_shared<model::Model>();
  robot->name = "crowd_robot";
  robot->links.resize(1);
  robot->links[0].name = "base";
  robot->links[0].collisions.push_back(
      {"body", {{0, 0, 0.15}, {}}, geometry::Cylinder{kCrowdRobotRadius, 0.3}, {}});
  robot->drive.emplace();
  robot->drive->kind = model::DriveKind::kVelocity;
  for (int i = 0; i < kCrowdRays; ++i) {
    model::SensorDescription ray;
    ray.name = "ray_" + std::to_string(i);
    ray.type = "sonar";
    const double bearing = 2 * std::numbers::pi * i / kCrowdRays;
    ray.link_from_sensor = {{0, 0, kCrowdRayHeight}, geometry::FromRollPitchYaw({0, 0, bearing})};
    ray.parameters = {{"min", 0.0}, {"max", kCrowdRange}};
    robot->sensors.push_back(std::move(ray));
  }
  return robot;
}

double Uniform(base::Noise& noise, double low, double high) {
  return low + (high - low) * noise.Uniform();
}

}  // namespace

std::shared_ptr<const model::WorldDescription> CrowdWorld(int robots, std::uint64_t seed) {
  const Raster raster(robots);
  base::Noise noise(seed, base::StableId("boxes"), 0);
  auto world = std::make_shared<model::WorldDescription>();
  world->name = "crowd";
  world->max_step_size = std::chrono::milliseconds(10);
  const double out = raster.side() / 2 + kWallThickness / 2;
  for (int i = 0; i < 4; ++i) {
    const double angle = i * std::numbers::pi / 2;
    world->models.push_back(
        StandingBox("wall_" + std::to_string(i),
                    {kWallThickness, raster.side() + 2 * kWallThickness, kWallHeight},
                    PlanarPose(out * std::cos(angle), out * std::sin(angle), 0, angle)));
  }
  int boxes = 0;
  for (int row = 1; row < raster.columns; row += 2) {
    for (int column = 1; column < raster.columns && boxes < robots / 4; column += 2) {
      const double x = raster.Line(column) + Uniform(noise, -0.3, 0.3);
      const double y = raster.Line(row) + Uniform(noise, -0.3, 0.3);
      world->models.push_back(
          StandingBox("box_" + std::to_string(++boxes), {kBoxSide, kBoxSide, kBoxSide},
                      PlanarPose(x, y, 0, Uniform(noise, 0, std::numbers::pi))));
    }
  }
  return world;
}

std::vector<simulation::RobotSpecification> CrowdRobots(int robots, std::uint64_t seed) {
  const Raster raster(robots);
  base::Noise noise(seed, base::StableId("robots"), 0);
  const auto model = CrowdRobot();
  std::vector<simulation::RobotSpecification> crowd(static_cast<std::size_t>(robots));
  for (int i = 0; i < robots; ++i) {
    simulation::RobotSpecification& robot = crowd[static_cast<std::size_t>(i)];
    robot.name = "robot_" + std::to_string(i);
    robot.model = model;
    robot.on_ground = false;
    const int row = i / raster.columns;
    const int column = i % raster.columns;
    const double x = raster.Line(column + 0.5) + Uniform(noise, -0.2, 0.2);
    const double y = raster.Line(row + 0.5) + Uniform(noise, -0.2, 0.2);
    robot.world_from_robot =
        PlanarPose(x, y, 0, Uniform(noise, -std::numbers::pi, std::numbers::pi));
  }
  return crowd;
}

base::Status CrowdController::Init(Robot& robot) {
  for (int i = 0; i < kCrowdRays; ++i) {
    if (auto ok = robot.OpenSensor("ray_" + std::to_string(i)); !ok) return ok;
  }
  return {};
}

DriveCommand CrowdController::Control(const std::vector<Reading>& readings) {
  const auto range = [&](int ray) {
    return readings[static_cast<std::size_t>((ray + kCrowdRays) % kCrowdRays)].values[0];
  };
  const double ahead = std::min({range(0), range(1), range(-1)});
  if (ahead < kCrowdRobotRadius + (turn_ == 0 ? 0.3 : 0.6)) {
    if (turn_ == 0) turn_ = range(1) + range(2) >= range(-1) + range(-2) ? 1 : -1;
    return {0, 1.5 * turn_};
  }
  turn_ = 0;
  return {0.5, 0};
}

}  // namespace gsv::app
