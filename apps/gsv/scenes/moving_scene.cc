#include "apps/gsv/scenes/moving_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/scenes/crowd_scenario.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {
namespace {

using geometry::PlanarPose;
using geometry::Vector3;

constexpr double kEyeHeight = 1.1;  // in m
constexpr int kMaxScenePlacements = 2000;

class DriveInCircles final : public Controller {
 public:
  DriveInCircles() : Controller(std::chrono::milliseconds(100)) {}
  DriveCommand Control(const std::vector<Reading>&) override { return {0.4, 0.5}; }
};

std::shared_ptr<simulation::BehaviourPort> Circles() {
  return std::make_shared<hosting::HostedBehaviour>(
      "circles", [] { return std::make_unique<DriveInCircles>(); });
}

// Returns the square of the crowd with visible collision shapes, and with a floor.
std::shared_ptr<const model::WorldDescription> VisibleSquare(int robots) {
  auto world = std::make_shared<model::WorldDescription>(*CrowdWorld(robots, 1));
  for (model::PlacedModel& placed : world->models) {
    auto model = std::make_shared<model::Model>(*placed.model);
    for (const model::Collision& collision : model->links[0].collisions) {
      model::Visual visual;
      visual.shape = collision.shape;
      visual.link_from_visual = collision.link_from_collision;
      model->links[0].visuals.push_back(visual);
    }
    placed.model = std::move(model);
  }
  auto floor = std::make_shared<model::Model>();
  floor->name = "floor";
  floor->is_static = true;
  floor->links.resize(1);
  floor->links[0].visuals.emplace_back();
  floor->links[0].visuals[0].shape = geometry::Plane{{0, 0, 1}, {500, 500}};
  world->models.push_back({"floor", std::move(floor), {}, true});
  return world;
}

void CollideWithVisuals(model::WorldDescription& world) {
  for (model::PlacedModel& placed : world.models) {
    if (!placed.is_static) continue;
    auto model = std::make_shared<model::Model>(*placed.model);
    for (model::Link& link : model->links) {
      // Replaces the collision shapes by the visuals, but keeps the planes among the collision
      // shapes. A visual that is a plane is skipped. It is a rectangle, but as a collision shape it
      // would be an infinite half-space.
      std::erase_if(link.collisions, [](const model::Collision& collision) {
        return !std::holds_alternative<geometry::Plane>(collision.shape);
      });
      for (const model::Visual& visual : link.visuals) {
        if (std::holds_alternative<geometry::Plane>(visual.shape)) continue;
        link.collisions.push_back({visual.name, visual.link_from_visual, visual.shape, {}});
      }
    }
    placed.model = std::move(model);
  }
}

base::Status PlaceOnTheSquare(MovingScene& scene, std::shared_ptr<const model::Model> model,
                              int count) {
  auto robots = CrowdRobots(count, 1);
  for (simulation::RobotSpecification& robot : robots) {
    robot.model = model;
    robot.behaviour = Circles();
  }
  auto names = scene.simulation->AddRobots(std::move(robots));
  if (!names) return base::Fail(names.error());
  scene.robots = *std::move(names);
  return {};
}

base::Status PlaceInASpiral(MovingScene& scene, std::shared_ptr<const model::Model> model,
                            int count) {
  base::Result<std::string> name;
  for (int n = 0; n < kMaxScenePlacements && static_cast<int>(scene.robots.size()) < count; ++n) {
    const double turns = std::sqrt(static_cast<double>(n));
    const double angle = turns * std::numbers::pi * 2 / 1.8;
    simulation::RobotSpecification robot;
    robot.model = model;
    robot.behaviour = Circles();
    robot.world_from_robot =
        PlanarPose(0.7 * turns * std::cos(angle), 0.7 * turns * std::sin(angle), 0, angle);
    name = scene.simulation->AddRobot(std::move(robot));
    if (name) scene.robots.push_back(*name);
  }
  if (static_cast<int>(scene.robots.size()) < count) return base::Fail(name.error());
  return {};
}

}  // namespace

base::Result<MovingScene> MovingScene::Create(const MovingSceneOptions& options) {
  formats::ReadOptions reading;
  reading.model_path = {ShareFolder() / "models"};
  formats::ModelLibrary library(reading);
  base::Problems problems;
  simulation::Specification specification;
  if (options.world == "square") {
    specification.world = VisibleSquare(options.robots);
  } else {
    const auto file = FindWorld(options.world);
    if (!file) return base::Fail(file.error());
    auto read = library.ReadWorld(*file, problems);
    if (!read) return base::Fail(read.error());
    if (options.collide_with_visuals) CollideWithVisuals(*read);
    specification.world = std::make_shared<model::WorldDescription>(*std::move(read));
  }
  const auto robot = library.ReadModel(options.model, problems);
  if (!robot) return base::Fail(robot.error());
  specification.name = "bench";
  specification.mode = options.mode;
  specification.step = std::chrono::milliseconds(10);
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  auto simulation = simulation::Simulation::Create(specification, sensors);
  if (!simulation) return base::Fail(simulation.error());
  MovingScene scene;
  scene.simulation = *std::move(simulation);
  const auto placed = options.world == "square" ? PlaceOnTheSquare(scene, *robot, options.robots)
                                                : PlaceInASpiral(scene, *robot, options.robots);
  if (!placed) return base::Fail(placed.error());
  return scene;
}

std::vector<rendering::CameraView> MovingScene::RobotViews(
    const world::Snapshot& snapshot, int count, const rendering::CameraParameters& camera) const {
  const double t = 0.01 * static_cast<double>(snapshot.state.step);
  std::vector<rendering::CameraView> views;
  for (int i = 0; i < count; ++i) {
    const int n = static_cast<int>(robots.size());
    const int body = snapshot.layout->Find(robots[static_cast<std::size_t>(i % n)]);
    const geometry::Pose& world_from_robot =
        snapshot.state.bodies[static_cast<std::size_t>(body)].world_from_model;
    const int earlier = i / n;  // the number of earlier cameras on the same robot
    const double yaw = 0.5 * std::sin(0.7 * t + i) + 2.1 * earlier;
    const geometry::Pose robot_from_camera{{0.13 * std::cos(yaw), 0.13 * std::sin(yaw), kEyeHeight},
                                           geometry::FromRollPitchYaw({0, 0.1, yaw})};
    views.push_back({world_from_robot * robot_from_camera, camera});
  }
  return views;
}

std::vector<rendering::CameraView> MovingScene::Overviews(
    const world::Snapshot& snapshot, int count, const rendering::CameraParameters& camera) const {
  double radius = 5;
  for (const std::string& robot : robots) {
    const int body = snapshot.layout->Find(robot);
    const Vector3& p =
        snapshot.state.bodies[static_cast<std::size_t>(body)].world_from_model.position;
    radius = std::max(radius, std::hypot(p.x, p.y));
  }
  // The cameras look down at 45°. The smaller of their two fields of view must cover the circle of
  // the robots.
  const double half_height = std::min(1.0, static_cast<double>(camera.height) / camera.width) *
                             std::tan(0.5 * camera.horizontal_fov);
  const double distance = radius / std::sin(std::atan(half_height));
  const double t = 0.01 * static_cast<double>(snapshot.state.step);
  std::vector<rendering::CameraView> views;
  for (int i = 0; i < count; ++i) {
    const double a = 0.2 * t + 2 * std::numbers::pi * i / count;
    const double out = distance * std::numbers::sqrt2 / 2;
    views.push_back({{{-out * std::cos(a), -out * std::sin(a), out},
                      geometry::FromRollPitchYaw({0, std::numbers::pi / 4, a})},
                     camera});
  }
  return views;
}

std::uint64_t TrianglesIn(const world::Layout& layout) {
  std::uint64_t triangles = 0;
  for (const world::Body& body : layout.bodies) {
    for (const model::Link& link : body.model->links) {
      for (const model::Visual& visual : link.visuals) {
        const auto* mesh = std::get_if<geometry::Mesh>(&visual.shape);
        triangles += mesh != nullptr ? mesh->triangles->triangles.size()
                                     : geometry::Tessellate(visual.shape).triangles.size();
      }
    }
  }
  return triangles;
}

Solids SolidsIn(const world::Layout& layout) {
  Solids solids;
  for (const world::Body& body : layout.bodies) {
    for (const model::Link& link : body.model->links) {
      for (const model::Collision& collision : link.collisions) {
        const auto* mesh = std::get_if<geometry::Mesh>(&collision.shape);
        if (mesh == nullptr) ++solids.shapes;
        if (mesh != nullptr) solids.triangles += mesh->triangles->triangles.size();
      }
    }
  }
  return solids;
}

}  // namespace gsv::app
