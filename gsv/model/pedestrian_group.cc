#include "gsv/model/pedestrian_group.h"

#include <array>
#include <cmath>

namespace gsv::model {
namespace {

constexpr double kMaxGoalCoordinate = 1e6;  // m

bool IsWithin(double value, double low, double high) { return value >= low && value <= high; }

Visual PartOf(const char* name, const geometry::Shape& shape, double z, const Colour& colour,
              double x = 0) {
  Visual visual;
  visual.name = name;
  visual.shape = shape;
  visual.link_from_visual.position = {x, 0, z};
  visual.materials[0].base_colour = colour;
  return visual;
}

// Returns an arm or a leg below `top` that swings forwards by an angle in radians.
Visual LimbOf(const char* name, const geometry::Vector3& top, double length, double radius,
              double swing, const Colour& colour) {
  Visual visual;
  visual.name = name;
  visual.shape = geometry::Cylinder{radius, length};
  const geometry::Quaternion turn = geometry::FromAxisAngle({0, 1, 0}, -swing);
  visual.link_from_visual = {
      top + geometry::Vector3{std::sin(swing), 0, -std::cos(swing)} * (length / 2), turn};
  visual.materials[0].base_colour = colour;
  return visual;
}

}  // namespace

base::Status Check(const PedestrianGroup& group) {
  const auto refuse = [&](const char* message) {
    return base::Fail(base::ErrorCode::kInvalidArgument, message, group.name);
  };
  if (group.name.empty()) return refuse("a group of pedestrians needs a name");
  if (group.count < 1 || group.count > kMaxPedestrians) {
    return refuse("a group has 1 to 100,000 pedestrians");
  }
  if (group.route.empty()) return refuse("pedestrians need a route of at least one goal");
  for (const PedestrianGoal& goal : group.route) {
    if (!IsWithin(goal.x, -kMaxGoalCoordinate, kMaxGoalCoordinate) ||
        !IsWithin(goal.y, -kMaxGoalCoordinate, kMaxGoalCoordinate) ||
        !IsWithin(goal.radius, 0, kMaxGoalCoordinate)) {
      return refuse("a goal's x and y must be numbers from -1e6 to 1e6, its radius from 0 to 1e6");
    }
  }
  if (!IsWithin(group.z, -kMaxGoalCoordinate, kMaxGoalCoordinate))
    return refuse("z must be a number from -1e6 to 1e6");
  if (!IsWithin(group.speed, 0.01, 10)) return refuse("the speed must lie between 0.01 and 10 m/s");
  if (!IsWithin(group.speed_deviation, 0, 5)) {
    return refuse("the speed's deviation must lie between 0 and 5 m/s");
  }
  if (!IsWithin(group.radius, 0.05, 1)) return refuse("the radius must lie between 0.05 and 1 m");
  if (!IsWithin(group.height, 0.2, 3)) return refuse("the height must lie between 0.2 and 3 m");
  return {};
}

std::shared_ptr<const Model> PedestrianModel(const PedestrianGroup& group, int look) {
  static constexpr std::array<Colour, kPedestrianLooks> kTops{{{0.16, 0.40, 0.60},
                                                               {0.75, 0.32, 0.22},
                                                               {0.30, 0.52, 0.36},
                                                               {0.87, 0.68, 0.25},
                                                               {0.45, 0.33, 0.55},
                                                               {0.82, 0.82, 0.78},
                                                               {0.22, 0.25, 0.30},
                                                               {0.60, 0.22, 0.35}}};
  static constexpr std::array<Colour, 4> kTrousers{
      {{0.13, 0.17, 0.27}, {0.25, 0.24, 0.22}, {0.36, 0.31, 0.25}, {0.18, 0.20, 0.22}}};
  static constexpr std::array<Colour, 3> kSkins{
      {{0.87, 0.70, 0.57}, {0.66, 0.47, 0.35}, {0.42, 0.29, 0.22}}};
  const auto i = static_cast<std::size_t>(look);
  const double h = group.height, w = std::min(group.radius, 0.14 * h);
  auto model = std::make_shared<Model>();
  model->name = "pedestrian";
  Link& link = model->links.emplace_back();
  link.name = "body";
  link.inertial.mass = 75;
  const Colour &trousers = kTrousers[i % kTrousers.size()], &top = kTops[i % kTops.size()];
  // The figure is modelled in the middle of a step.
  constexpr double kStride = 0.3, kSwing = 0.35;  // rad
  const double hip = 0.5 * h, leg = hip / std::cos(kStride), shoulder = 0.8 * h;
  link.visuals.push_back(LimbOf("left_leg", {0, 0.34 * w, hip}, leg, 0.3 * w, kStride, trousers));
  link.visuals.push_back(
      LimbOf("right_leg", {0, -0.34 * w, hip}, leg, 0.3 * w, -kStride, trousers));
  link.visuals.push_back(
      LimbOf("left_arm", {0, 0.85 * w, shoulder}, 0.34 * h, 0.15 * w, -kSwing, top));
  link.visuals.push_back(
      LimbOf("right_arm", {0, -0.85 * w, shoulder}, 0.34 * h, 0.15 * w, kSwing, top));
  link.visuals.push_back(
      PartOf("torso", geometry::Ellipsoid{{0.5 * w, 0.8 * w, 0.2 * h}}, 0.65 * h, top));
  link.visuals.push_back(PartOf("head", geometry::Ellipsoid{{0.055 * h, 0.045 * h, 0.07 * h}},
                                0.93 * h, kSkins[i % kSkins.size()], 0.01 * h));
  Collision collision;
  collision.name = "body";
  collision.shape = geometry::Cylinder{group.radius, h};
  collision.link_from_collision.position.z = h / 2;
  link.collisions.push_back(std::move(collision));
  return model;
}

}  // namespace gsv::model
