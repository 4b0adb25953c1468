#include "gsv/model/wheels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace gsv::model {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr int kDirections = 16;  // number of directions in which a wheel's extent is measured
// Minimum ratio of the smallest to the largest extent; a 12-sided mesh counts as round.
constexpr double kRoundness = 0.88;
constexpr double kMinRadius = 0.005;  // m
// Maximum sine of an axle's slope, because wheels may have camber.
constexpr double kLevel = 0.35;
constexpr double kUpright = 0.9;   // minimum cosine between a swivel and the vertical
constexpr double kManyTurns = 20;  // rad: a joint with a larger range turns freely

// The extent of a shape from its origin, along a direction in its own frame.
struct Reach {
  Vector3 d;  // unit length

  double operator()(const geometry::Box& box) const {
    return (std::abs(d.x) * box.size.x + std::abs(d.y) * box.size.y + std::abs(d.z) * box.size.z) /
           2;
  }
  double operator()(const geometry::Sphere& sphere) const { return sphere.radius; }
  double operator()(const geometry::Cylinder& cylinder) const {
    return cylinder.radius * std::hypot(d.x, d.y) + cylinder.length / 2 * std::abs(d.z);
  }
  double operator()(const geometry::Capsule& capsule) const {
    return capsule.radius + capsule.length / 2 * std::abs(d.z);
  }
  double operator()(const geometry::Ellipsoid& e) const {
    return std::hypot(e.radii.x * d.x, e.radii.y * d.y, e.radii.z * d.z);
  }
  double operator()(const geometry::Cone& cone) const {
    return std::max(cone.length / 2 * d.z,
                    cone.radius * std::hypot(d.x, d.y) - cone.length / 2 * d.z);
  }
  double operator()(const geometry::Plane&) const {
    return -std::numeric_limits<double>::infinity();
  }
  double operator()(const geometry::Mesh& mesh) const {
    const Vector3 scaled = geometry::Scaled(d, mesh.scale);
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vector3& point : mesh.triangles->positions) {
      reach = std::max(reach, Dot(scaled, point));
    }
    return reach;
  }
};

// Measures how far shapes extend from an axis through `origin`: the radius perpendicular to the
// axis, and the length along it.
class Extent {
 public:
  Extent(const Vector3& origin, const Vector3& axis) : origin_(origin), axis_(axis) {
    const Vector3 other = std::abs(axis.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
    const Vector3 u = Normalized(Cross(axis, other));
    const Vector3 v = Cross(axis, u);
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      directions_[static_cast<std::size_t>(i)] = std::cos(angle) * u + std::sin(angle) * v;
    }
    across_.fill(-std::numeric_limits<double>::infinity());
  }

  void Add(const Pose& model_from_shape, const geometry::Shape& shape) {
    if (std::holds_alternative<geometry::Plane>(shape)) return;
    const auto reach = [&](const Vector3& direction) {
      const Vector3 local = geometry::Inverse(model_from_shape.orientation) * direction;
      return Dot(model_from_shape.position - origin_, direction) + std::visit(Reach{local}, shape);
    };
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      across_[i] = std::max(across_[i], reach(directions_[i]));
    }
    ahead_ = std::max(ahead_, reach(axis_));
    behind_ = std::max(behind_, reach(-axis_));
  }

  double radius() const { return *std::max_element(across_.begin(), across_.end()); }
  bool is_round() const {
    const double least = *std::min_element(across_.begin(), across_.end());
    return std::isfinite(radius()) && radius() > kMinRadius && least > kRoundness * radius();
  }
  // Returns the point on the axis that is halfway between the two ends of the shapes.
  Vector3 middle() const { return origin_ + (ahead_ - behind_) / 2 * axis_; }

 private:
  Vector3 origin_, axis_;
  std::array<Vector3, kDirections> directions_;
  std::array<double, kDirections> across_;
  double ahead_ = -std::numeric_limits<double>::infinity();
  double behind_ = -std::numeric_limits<double>::infinity();
};

// Returns the joint whose child is that link, or -1.
int JointInto(const Model& model, int link) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].child == link) return static_cast<int>(j);
  }
  return -1;
}

// Returns the link and all links that fixed joints connect to it.
std::vector<int> RigidPart(const Model& model, int link) {
  std::vector<int> part{link};
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (const Joint& joint : model.joints) {
      if (joint.kind == JointKind::kFixed && joint.parent == part[i]) part.push_back(joint.child);
    }
  }
  return part;
}

Vector3 AxisInModel(const Joint& joint) { return joint.model_from_joint.orientation * joint.axis; }

std::optional<int> SwivelOf(const Model& model, int joint) {
  int link = model.joints[static_cast<std::size_t>(joint)].parent;
  // The loop ends, because the joints form a forest.
  while (link >= 0) {
    const int above = JointInto(model, link);
    if (above < 0) break;
    const Joint& holder = model.joints[static_cast<std::size_t>(above)];
    const bool turns = holder.kind == JointKind::kRevolute || holder.kind == JointKind::kContinuous;
    if (turns && std::abs(AxisInModel(holder).z) > kUpright) return above;
    link = holder.parent;
  }
  return std::nullopt;
}

bool HasShape(const Model& model, const std::vector<int>& part) {
  return std::any_of(part.begin(), part.end(), [&](int index) {
    const Link& link = model.links[static_cast<std::size_t>(index)];
    return !link.collisions.empty() || !link.visuals.empty();
  });
}

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Wheel WheelOn(const Model& model, int joint) {
  Wheel wheel;
  wheel.joint = joint;
  wheel.axis = AxisInModel(model.joints[static_cast<std::size_t>(joint)]);
  wheel.centre = model.joints[static_cast<std::size_t>(joint)].model_from_joint.position;
  wheel.swivel = SwivelOf(model, joint);
  return wheel;
}

bool Collides(const Model& model) {
  return std::any_of(model.links.begin(), model.links.end(),
                     [](const Link& link) { return !link.collisions.empty(); });
}

}  // namespace

bool TurnsFreely(const Joint& joint) {
  if (joint.kind == JointKind::kContinuous) return true;
  return joint.kind == JointKind::kRevolute &&
         joint.position_limits.max - joint.position_limits.min > kManyTurns;
}

std::optional<Wheel> MeasureWheel(const Model& model, int joint) {
  Wheel wheel = WheelOn(model, joint);
  const Vector3 origin = wheel.centre;
  const std::vector<int> part =
      RigidPart(model, model.joints[static_cast<std::size_t>(joint)].child);
  Extent collisions(origin, wheel.axis), visuals(origin, wheel.axis);
  for (const int index : part) {
    const Link& link = model.links[static_cast<std::size_t>(index)];
    for (const Collision& collision : link.collisions) {
      collisions.Add(link.model_from_link * collision.link_from_collision, collision.shape);
    }
  }
  if (!collisions.is_round()) {
    for (const int index : part) {
      const Link& link = model.links[static_cast<std::size_t>(index)];
      for (const Visual& visual : link.visuals) {
        visuals.Add(link.model_from_link * visual.link_from_visual, visual.shape);
      }
    }
    if (!visuals.is_round()) return std::nullopt;
  }
  const Extent& measured = collisions.is_round() ? collisions : visuals;
  wheel.radius = measured.radius();
  wheel.centre = measured.middle();
  return wheel;
}

std::vector<Wheel> FindWheels(const Model& model) {
  std::vector<Wheel> wheels;
  double lowest = Collides(model) ? LowestPoint(model) : std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    if (!TurnsFreely(joint) || std::abs(AxisInModel(joint).z) > kLevel) continue;
    auto wheel = MeasureWheel(model, static_cast<int>(j));
    if (!wheel && !HasShape(model, RigidPart(model, joint.child))) {
      wheel = WheelOn(model, static_cast<int>(j));
      if (!IsNamed(model, *wheel, {"wheel"})) continue;
    }
    if (!wheel) continue;
    if (wheel->radius > 0) lowest = std::min(lowest, wheel->centre.z - wheel->radius);
    wheels.push_back(*wheel);
  }
  std::erase_if(wheels, [&](const Wheel& wheel) {
    return wheel.radius > 0 && wheel.centre.z - wheel.radius > lowest + wheel.radius / 2;
  });
  return wheels;
}

bool IsNamed(const Model& model, const Wheel& wheel, std::initializer_list<const char*> words) {
  const Joint& joint = model.joints[static_cast<std::size_t>(wheel.joint)];
  std::string names = joint.name + " " + model.links[static_cast<std::size_t>(joint.child)].name;
  if (wheel.swivel) names += " " + model.joints[static_cast<std::size_t>(*wheel.swivel)].name;
  names = LowerCase(std::move(names));
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return names.find(word) != std::string::npos; });
}

}  // namespace gsv::model
