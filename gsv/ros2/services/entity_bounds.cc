#include "gsv/ros2/services/entity_bounds.h"

#include <algorithm>
#include <limits>
#include <variant>

#include "gsv/geometry/box_corners.h"
#include "gsv/geometry/shape.h"

namespace gsv::ros2 {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class GrowingBox {
 public:
  void Include(const geometry::Bounds& bounds, const geometry::Pose& pose) {
    for (const geometry::Vector3& corner : geometry::CornersOf(bounds)) {
      const geometry::Vector3 p = pose * corner;
      box_.min = {std::min(box_.min.x, p.x), std::min(box_.min.y, p.y), std::min(box_.min.z, p.z)};
      box_.max = {std::max(box_.max.x, p.x), std::max(box_.max.y, p.y), std::max(box_.max.z, p.z)};
    }
  }
  void Include(const geometry::Shape& shape, const geometry::Pose& pose) {
    has_plane_ = has_plane_ || std::holds_alternative<geometry::Plane>(shape);
    Include(geometry::BoundsOf(shape), pose);
  }
  bool is_empty() const { return box_.min.x > box_.max.x; }
  bool has_plane() const { return has_plane_; }
  const geometry::Bounds& box() const { return box_; }

 private:
  geometry::Bounds box_{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  bool has_plane_ = false;
};

}  // namespace

std::optional<geometry::Bounds> BoundsOfBody(const world::Snapshot& snapshot, int body) {
  const world::Body& described = snapshot.layout->bodies[static_cast<std::size_t>(body)];
  const geometry::Pose model_from_world =
      Inverse(snapshot.state.bodies[static_cast<std::size_t>(body)].world_from_model);
  const std::vector<geometry::Pose> links = world::LinkPoses(snapshot, body);
  GrowingBox solid, seen;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const geometry::Pose model_from_link = model_from_world * links[i];
    const model::Link& link = described.model->links[i];
    for (const auto& collision : link.collisions) {
      solid.Include(collision.shape, model_from_link * collision.link_from_collision);
    }
    for (const auto& visual : link.visuals) {
      seen.Include(visual.shape, model_from_link * visual.link_from_visual);
    }
  }
  const GrowingBox& box = solid.is_empty() ? seen : solid;
  if (box.is_empty() || box.has_plane()) return std::nullopt;
  return box.box();
}

geometry::Bounds InWorld(const geometry::Bounds& bounds, const geometry::Pose& world_from_body) {
  GrowingBox box;
  box.Include(bounds, world_from_body);
  return box.box();
}

}  // namespace gsv::ros2
