#include "apps/gsv/scenes/rigid_scenario.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace gsv::app {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr double kSpacing = 2;  // distance between rovers or arms, m
constexpr model::Surface kSurface{0.8, 0.8, 0, {}, {}};

model::Link LinkOf(std::string name, const geometry::Shape& shape, double mass,
                   const Vector3& inertia, const Pose& model_from_link) {
  model::Link link;
  link.name = std::move(name);
  link.model_from_link = model_from_link;
  link.inertial = {mass, {}, inertia.x, inertia.y, inertia.z};
  link.collisions.push_back({"collision", {}, shape, kSurface});
  return link;
}

model::Link BoxLink(std::string name, const Vector3& size, double mass, const Pose& pose = {}) {
  const double x2 = size.x * size.x, y2 = size.y * size.y, z2 = size.z * size.z;
  const Vector3 inertia = mass / 12 * Vector3{y2 + z2, x2 + z2, x2 + y2};
  return LinkOf(std::move(name), geometry::Box{size}, mass, inertia, pose);
}

model::Link CylinderLink(std::string name, double radius, double length, double mass,
                         const Pose& pose) {
  const double across = mass * (3 * radius * radius + length * length) / 12;
  return LinkOf(std::move(name), geometry::Cylinder{radius, length}, mass,
                {across, across, mass * radius * radius / 2}, pose);
}

model::Joint MotorJoint(std::string name, int parent, int child, const Vector3& position,
                        const Vector3& axis, double effort_limit) {
  model::Joint joint;
  joint.name = std::move(name);
  joint.kind = model::JointKind::kContinuous;
  joint.parent = parent;
  joint.child = child;
  joint.model_from_joint = {position, {}};
  joint.axis = axis;
  joint.effort_limit = effort_limit;
  return joint;
}

// The rover's left wheels are faster than its right wheels. So the rover turns, and its wheels
// slip.
std::shared_ptr<const model::Model> Rover() {
  using model::JointTarget;
  auto rover = std::make_shared<model::Model>();
  rover->name = "rover";
  rover->links.push_back(BoxLink("base", {0.6, 0.4, 0.2}, 20));
  for (int i = 0; i < 4; ++i) {
    const bool is_left = (i & 2) != 0;
    const Vector3 position{(i & 1) != 0 ? 0.22 : -0.22, is_left ? 0.27 : -0.27, -0.1};
    const std::string number = std::to_string(i);
    rover->links.push_back(
        CylinderLink("wheel_" + number, 0.12, 0.08, 1,
                     {position, geometry::FromAxisAngle({1, 0, 0}, -std::numbers::pi / 2)}));
    rover->joints.push_back(MotorJoint("joint_" + number, 0, i + 1, position, {0, 1, 0}, 20));
    rover->joint_targets.push_back({i, JointTarget::Kind::kVelocity, is_left ? 5.0 : 3.0});
  }
  return rover;
}

std::shared_ptr<const model::Model> HeapBox() {
  auto box = std::make_shared<model::Model>();
  box->name = "box";
  box->links.push_back(BoxLink("box", {0.3, 0.3, 0.3}, 1));
  return box;
}

// The arm stands on the ground, to which a joint attaches it.
std::shared_ptr<const model::Model> Arm() {
  using model::JointTarget;
  constexpr double kLength = 0.25;  // length of each part, m
  const std::vector<Vector3> axes{{0, 0, 1}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}};
  auto arm = std::make_shared<model::Model>();
  arm->name = "arm";
  arm->links.push_back(CylinderLink("base", 0.1, 0.1, 5, {{0, 0, 0.051}, {}}));
  model::Joint& to_world = arm->joints.emplace_back();
  to_world.name = "to_world";
  for (int i = 0; i < static_cast<int>(axes.size()); ++i) {
    const std::string number = std::to_string(i);
    const Vector3 position{0, 0, 0.12 + i * kLength};
    const Vector3 centre = position + Vector3{0, 0, kLength / 2};
    const double mass = 2.0 / (1 + i);
    arm->links.push_back(CylinderLink("part_" + number, 0.04, kLength - 0.03, mass, {centre, {}}));
    arm->joints.push_back(MotorJoint("joint_" + number, i, i + 1, position, axes[i], 100));
    arm->joint_targets.push_back({i + 1, JointTarget::Kind::kPosition, i % 2 == 0 ? 0.6 : -0.4});
  }
  return arm;
}

// A square terrain with waves in both directions, and a vertex every 0.25 m.
geometry::Mesh Waves(double low, double high) {
  constexpr double kEdge = 0.25, kWave = 0.075, kPerMetre = 1.5;
  const int count = static_cast<int>(std::ceil((high - low) / kEdge));
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int row = 0; row <= count; ++row) {
    for (int column = 0; column <= count; ++column) {
      const double x = low + column * kEdge, y = low + row * kEdge;
      mesh->positions.push_back(
          {x, y, kWave * (std::sin(kPerMetre * x) * std::cos(kPerMetre * y) - 1)});
    }
  }
  const auto corner = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * (count + 1) + column);
  };
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const std::uint32_t a = corner(row, column), b = corner(row, column + 1);
      const std::uint32_t c = corner(row + 1, column + 1), d = corner(row + 1, column);
      mesh->triangles.push_back({a, b, c});
      mesh->triangles.push_back({a, c, d});
    }
  }
  return {std::move(mesh), {1, 1, 1}};
}

Vector3 PlaceOf(RigidScenario scenario, int index, int bodies) {
  if (scenario == RigidScenario::kBoxes) {
    const int side = static_cast<int>(std::ceil(std::cbrt(bodies)));
    const int column = index % side, row = index / side % side, layer = index / (side * side);
    return {column * 0.35 + 0.02 * (index % 7), row * 0.35 + 0.013 * (index % 5),
            0.3 + layer * 0.4};
  }
  const int side = static_cast<int>(std::ceil(std::sqrt(bodies)));
  const double height = scenario == RigidScenario::kArms ? 0 : 0.22;
  return {index % side * kSpacing, index / side * kSpacing, height};
}

std::shared_ptr<const model::Model> BodyOf(RigidScenario scenario) {
  if (scenario == RigidScenario::kBoxes) return HeapBox();
  return scenario == RigidScenario::kArms ? Arm() : Rover();
}

std::shared_ptr<const model::Model> GroundOf(RigidScenario scenario, int bodies) {
  constexpr double kMargin = 20;  // margin around the rovers, which drive in circles, m
  auto ground = std::make_shared<model::Model>();
  ground->name = "ground";
  ground->is_static = true;
  ground->links.resize(1);
  ground->links[0].name = "ground";
  geometry::Shape shape = geometry::Plane{};
  if (scenario == RigidScenario::kTerrain) {
    shape = Waves(-kMargin, std::ceil(std::sqrt(bodies)) * kSpacing + kMargin);
  }
  ground->links[0].collisions.push_back({"collision", {}, shape, kSurface});
  return ground;
}

}  // namespace

std::shared_ptr<const model::WorldDescription> RigidWorldOf(RigidScenario scenario, int bodies) {
  auto world = std::make_shared<model::WorldDescription>();
  world->name = "rigid";
  world->max_step_size = std::chrono::milliseconds(1);
  world->models.push_back({"ground", GroundOf(scenario, bodies), {}, true});
  const auto body = BodyOf(scenario);
  for (int i = 0; i < bodies; ++i) {
    // All names have five digits, so that their alphabetical order equals the numerical order.
    const std::string number = std::to_string(100'000 + i).substr(1);
    world->models.push_back({"body_" + number, body, {PlaceOf(scenario, i, bodies), {}}, false});
  }
  return world;
}

}  // namespace gsv::app
