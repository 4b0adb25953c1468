#include "gsv/model/model.h"

#include <algorithm>

#include "gsv/geometry/box_corners.h"

namespace gsv::model {
namespace {

using geometry::Pose;
using geometry::Vector3;

// Calls `visit` with each corner of each collision's bounding box, in the model's frame.
template <typename Visit>
void ForEachCorner(const Model& model, Visit visit) {
  for (const Link& link : model.links) {
    for (const Collision& collision : link.collisions) {
      if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
      const Pose model_from_collision = link.model_from_link * collision.link_from_collision;
      for (const Vector3& corner : geometry::CornersOf(geometry::BoundsOf(collision.shape))) {
        visit(model_from_collision * corner);
      }
    }
  }
}

}  // namespace

double FootprintRadius(const Model& model) {
  double radius = 0;
  ForEachCorner(model, [&](const Vector3& p) { radius = std::max(radius, std::hypot(p.x, p.y)); });
  return radius;
}

double LowestPoint(const Model& model) { return LowestPoint(model, {}); }

double LowestPoint(const Model& model, const geometry::Quaternion& world_from_model) {
  // A rotation about the vertical must not change heights, not even by rounding errors.
  const bool is_level = world_from_model.x == 0 && world_from_model.y == 0;
  double lowest = 0;
  bool any = false;
  ForEachCorner(model, [&](const Vector3& p) {
    const double z = is_level ? p.z : (world_from_model * p).z;
    lowest = any ? std::min(lowest, z) : z;
    any = true;
  });
  return lowest;
}

const char* NameOf(JointKind kind) {
  switch (kind) {
    case JointKind::kFixed:
      return "fixed";
    case JointKind::kRevolute:
      return "revolute";
    case JointKind::kContinuous:
      return "continuous";
    case JointKind::kPrismatic:
      return "prismatic";
    case JointKind::kBall:
      return "ball";
    case JointKind::kScrew:
      return "screw";
  }
  return "";
}

int FindJoint(const std::vector<Joint>& joints, const std::string& name) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name == name && TakesCommands(joints[j].kind)) return static_cast<int>(j);
  }
  return -1;
}

}  // namespace gsv::model
