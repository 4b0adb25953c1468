#include "gsv/dynamics/shapes/obstacles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "gsv/world/snapshot.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

// Seen from above, the slice of a half-space is a half-plane. A square of this side length (m)
// inside the half-plane, at its edge, represents it.
constexpr double kEndless = 20000;

void SlicePlane(const geometry::Plane& plane, const Pose& pose, Interval heights,
                std::vector<ConvexPiece>& pieces) {
  const Vector3 normal = pose.orientation * plane.normal;
  const double level = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  if (std::abs(normal.z) > level) return;
  const Vector2 out{normal.x / level, normal.y / level};
  const Vector2 along{-out.y, out.x};
  // Between the two heights, the half-space extends furthest in the direction `out` at one of them.
  const double height = normal.z > 0 ? heights.low : heights.high;
  const double shift = -normal.z * (height - pose.position.z) / level;
  const Vector2 edge = Vector2{pose.position.x, pose.position.y} + shift * out;
  const Vector2 side = (kEndless / 2) * along, back = kEndless * out;
  pieces.push_back(Hull({edge - side, edge + side, edge + side - back, edge - side - back}));
}

// Adds the pieces in `pieces` as obstacles, and clears `pieces`.
void AddObstacles(std::vector<ConvexPiece>& pieces, int body, const model::CollisionFilter& filter,
                  std::vector<Obstacle>& obstacles) {
  for (const ConvexPiece& piece : pieces) {
    const ConvexPiece disc = BoundingDisc(piece);
    obstacles.push_back({piece, disc.vertices[0], disc.radius, body, filter});
  }
  pieces.clear();
}

void SliceBody(const world::Body& body, const Pose& world_from_model, Interval heights, int index,
               std::vector<Obstacle>& obstacles) {
  std::vector<ConvexPiece> pieces;
  for (const model::Link& link : body.model->links) {
    for (const model::Collision& collision : link.collisions) {
      if (collision.surface.filter == model::kMeetsNothing) continue;
      const Pose pose = world_from_model * link.model_from_link * collision.link_from_collision;
      if (const auto* plane = std::get_if<geometry::Plane>(&collision.shape)) {
        SlicePlane(*plane, pose, heights, pieces);
      } else {
        Slice(collision.shape, pose, heights, pieces);
      }
      AddObstacles(pieces, index, collision.surface.filter, obstacles);
    }
  }
}

}  // namespace

std::vector<Obstacle> CollectObstacles(const world::Layout& layout, const world::State& state,
                                       Interval heights) {
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    const world::Body& body = layout.bodies[i];
    if (body.is_planar() || body.is_rigid() || body.is_actor()) continue;
    SliceBody(body, state.bodies[i].world_from_model, heights, static_cast<int>(i), obstacles);
  }
  return obstacles;
}

std::vector<Obstacle> CollectDynamicObstacles(const world::Layout& layout,
                                              const world::State& state,
                                              std::span<const int> bodies, Interval heights) {
  std::vector<Obstacle> obstacles;
  std::vector<ConvexPiece> pieces;
  for (const int i : bodies) {
    const world::Body& body = layout.bodies[i];
    const std::vector<Pose> model_from_link = world::LinkPoses(
        *body.model,
        std::span(state.joint_positions).subspan(body.first_joint, body.model->joints.size()));
    for (std::size_t l = 0; l < model_from_link.size(); ++l) {
      const Pose world_from_link = state.bodies[i].world_from_model * model_from_link[l];
      for (const model::Collision& collision : body.model->links[l].collisions) {
        if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
        if (collision.surface.filter == model::kMeetsNothing) continue;
        Slice(collision.shape, world_from_link * collision.link_from_collision, heights, pieces);
        AddObstacles(pieces, i, collision.surface.filter, obstacles);
      }
    }
  }
  return obstacles;
}

double DynamicRadius(const world::Body& body) {
  // Joints may move the shapes of a rigid body to any distance. They do not move the shapes of an
  // actor.
  if (!body.model->joints.empty() && !body.is_actor())
    return std::numeric_limits<double>::infinity();
  const std::vector<double> zero(body.model->joints.size(), 0.0);
  const std::vector<Pose> model_from_link = world::LinkPoses(*body.model, zero);
  double radius = 0;
  for (std::size_t l = 0; l < model_from_link.size(); ++l) {
    for (const model::Collision& collision : body.model->links[l].collisions) {
      if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
      const geometry::Bounds bounds = geometry::BoundsOf(collision.shape);
      const Vector3 farthest{std::max(std::abs(bounds.min.x), std::abs(bounds.max.x)),
                             std::max(std::abs(bounds.min.y), std::abs(bounds.max.y)),
                             std::max(std::abs(bounds.min.z), std::abs(bounds.max.z))};
      const Pose model_from_shape = model_from_link[l] * collision.link_from_collision;
      radius = std::max(radius, Norm(model_from_shape.position) + Norm(farthest));
    }
  }
  return radius;
}

}  // namespace gsv::dynamics
