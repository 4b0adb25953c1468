#include "gsv/dynamics/rigid/rigid_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <LinearMath/btConvexHullComputer.h>

#include "gsv/dynamics/shapes/connected_pieces.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// Bullet rounds the edges of boxes, cylinders and hulls with at most these radii, m.
constexpr double kMargin = 1e-3;
constexpr double kHullMargin = 1e-4;
constexpr int kMaxCorners = 64;

// Returns directions that are evenly spread over the sphere (Fibonacci lattice).
Vector3 Direction(int i, int count) {
  const double z = 1 - (2.0 * i + 1) / count;
  const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

// Returns the extreme points in many directions, for a body with too many corners.
std::vector<Vector3> Outermost(const std::vector<Vector3>& points) {
  std::vector<Vector3> corners;
  for (int i = 0; i < kMaxCorners; ++i) {
    const Vector3 direction = Direction(i, kMaxCorners);
    corners.push_back(*std::max_element(
        points.begin(), points.end(),
        [&](const Vector3& a, const Vector3& b) { return Dot(a, direction) < Dot(b, direction); }));
  }
  return corners;
}

std::vector<Vector3> HullCorners(const std::vector<Vector3>& points) {
  btConvexHullComputer computer;
  computer.compute(&points[0].x, sizeof(Vector3), static_cast<int>(points.size()), 0, 0);
  std::vector<Vector3> corners;
  corners.reserve(static_cast<std::size_t>(computer.vertices.size()));
  for (int i = 0; i < computer.vertices.size(); ++i) {
    corners.push_back(FromBullet(computer.vertices[i]));
  }
  return corners.size() > kMaxCorners ? Outermost(corners) : corners;
}

}  // namespace

template <typename T, typename... Arguments>
T* RigidShapes::Own(Arguments&&... arguments) {
  auto shape = std::make_unique<T>(std::forward<Arguments>(arguments)...);
  T* const raw = shape.get();
  shapes_.push_back(std::move(shape));
  return raw;
}

void RigidShapes::NextLayout() {
  shapes_.clear();
  used_before_ = std::move(meshes_);
  meshes_.clear();
}

btCollisionShape* RigidShapes::HullOf(const std::vector<Vector3>& points) {
  const std::vector<Vector3> corners = HullCorners(points);
  if (corners.size() < 4) return nullptr;
  auto* hull =
      Own<btConvexHullShape>(&corners[0].x, static_cast<int>(corners.size()), sizeof(Vector3));
  hull->setMargin(kHullMargin);
  hull->initializePolyhedralFeatures();
  return hull;
}

btCollisionShape* RigidShapes::Primitive(const geometry::Shape& shape) {
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    auto* made = Own<btBoxShape>(ToBullet(box->size * 0.5));
    made->setMargin(std::min(kMargin, 0.1 * std::min({box->size.x, box->size.y, box->size.z})));
    made->initializePolyhedralFeatures();
    return made;
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    return Own<btSphereShape>(sphere->radius);
  }
  if (const auto* c = std::get_if<geometry::Cylinder>(&shape)) {
    const btVector3 half(c->radius, c->radius, c->length / 2);
    auto* made = Own<btCylinderShapeZ>(half);
    made->setMargin(std::min({kMargin, 0.1 * c->radius, 0.05 * c->length}));
    return made;
  }
  if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) {
    return Own<btCapsuleShapeZ>(capsule->radius, capsule->length);
  }
  if (const auto* cone = std::get_if<geometry::Cone>(&shape)) {
    auto* made = Own<btConeShapeZ>(cone->radius, cone->length);
    made->setMargin(0);
    return made;
  }
  if (std::holds_alternative<geometry::Ellipsoid>(shape)) {
    return HullOf(geometry::Tessellate(shape, 16).positions);
  }
  return nullptr;
}

btBvhTriangleMeshShape* RigidShapes::MeshOf(const geometry::Mesh& mesh) {
  if (mesh.triangles->triangles.empty()) return nullptr;
  const MeshKey key{mesh.triangles.get(), mesh.scale.x, mesh.scale.y, mesh.scale.z};
  if (const auto known = meshes_.find(key); known != meshes_.end()) {
    return known->second->shape.get();
  }
  if (auto before = used_before_.extract(key)) {
    return meshes_.insert(std::move(before)).position->second->shape.get();
  }
  auto made = std::make_unique<StandingMesh>();
  made->source = mesh.triangles;
  for (const Vector3& position : mesh.triangles->positions) {
    const Vector3 p = Scaled(position, mesh.scale);
    made->positions.insert(made->positions.end(), {p.x, p.y, p.z});
  }
  for (const auto& triangle : mesh.triangles->triangles) {
    for (const std::uint32_t corner : triangle) made->indices.push_back(static_cast<int>(corner));
  }
  made->triangles = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(mesh.triangles->triangles.size()), made->indices.data(),
      static_cast<int>(3 * sizeof(int)), static_cast<int>(mesh.triangles->positions.size()),
      made->positions.data(), static_cast<int>(3 * sizeof(btScalar)));
  made->shape = std::make_unique<btBvhTriangleMeshShape>(made->triangles.get(), true);
  made->shape->setMargin(0);
  made->surface = std::make_unique<TriangleSurface>(*mesh.triangles, mesh.scale);
  made->shape->setUserPointer(made->surface.get());
  return meshes_.emplace(key, std::move(made)).first->second->shape.get();
}

btCollisionShape* RigidShapes::Standing(const geometry::Shape& shape) {
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) return MeshOf(*mesh);
  if (const auto* plane = std::get_if<geometry::Plane>(&shape)) {
    return Own<btStaticPlaneShape>(ToBullet(plane->normal), 0);
  }
  return Primitive(shape);
}

std::vector<btCollisionShape*> RigidShapes::Moving(const geometry::Shape& shape) {
  std::vector<btCollisionShape*> made;
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    for (const auto& piece : ConnectedPieces(*mesh, kMaxPieces)) {
      if (auto* hull = HullOf(piece)) made.push_back(hull);
    }
  } else if (auto* primitive = Primitive(shape)) {
    made.push_back(primitive);
  }
  return made;
}

btCollisionShape* RigidShapes::Prism(const Footprint::Piece& piece, double low,
                                     geometry::Pose& model_from_shape) {
  const double high = piece.heights.high;
  model_from_shape = {};
  if (piece.shape.vertex_count == 1) {
    const Vector2 centre = piece.shape.vertices[0];
    model_from_shape.position = {centre.x, centre.y, (low + high) / 2};
    return Primitive(geometry::Cylinder{piece.shape.radius, high - low});
  }
  std::vector<Vector3> corners;
  for (const Vector2 v : piece.shape.points()) {
    const int around = piece.shape.radius > 0 ? ConvexPiece::kMaxVertices : 1;
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      const double x = v.x + piece.shape.radius * std::cos(angle);
      const double y = v.y + piece.shape.radius * std::sin(angle);
      corners.insert(corners.end(), {{x, y, low}, {x, y, high}});
    }
  }
  return HullOf(corners);
}

}  // namespace gsv::dynamics
