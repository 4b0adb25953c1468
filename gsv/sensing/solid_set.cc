#include "gsv/sensing/solid_set.h"

#include <algorithm>

#include "gsv/base/check.h"
#include "gsv/sensing/box_tree.h"
#include "gsv/sensing/ray_shape.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Pose;
using geometry::Shape;
using geometry::Vector3;

// So few are looked at one by one.
constexpr std::size_t kHandful = 6;

Bounds BoundsOfTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

// Around the shape's own box, turned.
Bounds BoundsOfShape(const Shape& shape, const Pose& set_from_shape) {
  const Bounds own = geometry::BoundsOf(shape);
  Bounds bounds;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 p = set_from_shape * Vector3{corner & 1 ? own.max.x : own.min.x,
                                               corner & 2 ? own.max.y : own.min.y,
                                               corner & 4 ? own.max.z : own.min.z};
    if (corner == 0) bounds = {p, p};
    bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                  std::min(bounds.min.z, p.z)};
    bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                  std::max(bounds.max.z, p.z)};
  }
  return bounds;
}

Ray Moved(const Pose& to_from, const Ray& ray, double length) {
  return {to_from * ray.origin, to_from.orientation * ray.direction, length};
}

}  // namespace

SolidSet::SolidSet() = default;
SolidSet::~SolidSet() = default;
SolidSet::SolidSet(SolidSet&&) noexcept = default;
SolidSet& SolidSet::operator=(SolidSet&&) noexcept = default;

void SolidSet::Add(const Shape& shape, const Pose& set_from_shape, int body) {
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    AddMesh(*mesh, set_from_shape, body);
    return;
  }
  SolidShape solid{shape, Inverse(set_from_shape), {}, primitives_++, body};
  if (std::holds_alternative<geometry::Plane>(shape)) {
    planes_.push_back(std::move(solid));
    return;
  }
  solid.bounds = BoundsOfShape(shape, set_from_shape);
  Include(solid.bounds);
  shapes_.push_back(std::move(solid));
}

void SolidSet::AddMesh(const geometry::Mesh& mesh, const Pose& set_from_mesh, int body) {
  const geometry::TriangleMesh& triangles = *mesh.triangles;
  for (const auto& corners : triangles.triangles) {
    const auto corner = [&](int i) {
      return set_from_mesh * Scaled(triangles.positions[corners[i]], mesh.scale);
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    Include(BoundsOfTriangle(a, b, c));
    triangles_.push_back({a, b - a, c - a, primitives_++, body});
  }
}

void SolidSet::Include(const Bounds& b) {
  if (!bounded_) bounds_ = b;
  bounded_ = true;
  bounds_.min = {std::min(bounds_.min.x, b.min.x), std::min(bounds_.min.y, b.min.y),
                 std::min(bounds_.min.z, b.min.z)};
  bounds_.max = {std::max(bounds_.max.x, b.max.x), std::max(bounds_.max.y, b.max.y),
                 std::max(bounds_.max.z, b.max.z)};
}

Bounds SolidSet::BoundsOf(std::uint32_t candidate) const {
  if (candidate < shapes_.size()) return shapes_[candidate].bounds;
  const SolidTriangle& t = triangles_[candidate - shapes_.size()];
  return BoundsOfTriangle(t.corner, t.corner + t.edge1, t.corner + t.edge2);
}

void SolidSet::Commit() {
  const std::size_t count = shapes_.size() + triangles_.size();
  if (count <= kHandful) return;
  std::vector<Bounds> boxes;
  boxes.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) boxes.push_back(BoundsOf(i));
  tree_ = std::make_unique<BoxTree>();
  tree_->Build(std::move(boxes), /*often=*/false);
}

void SolidSet::CastAt(std::uint32_t candidate, const Ray& ray, int ignored_body, int body,
                      Nearest& nearest) const {
  if (candidate < shapes_.size()) {
    const SolidShape& solid = shapes_[candidate];
    const int whose = body >= 0 ? body : solid.body;
    if (whose == ignored_body) return;
    const auto hit = CastAtShape(Moved(solid.shape_from_set, ray, nearest.distance), solid.shape);
    if (!hit) return;
    nearest.Offer(hit->distance, whose, solid.primitive,
                  Inverse(solid.shape_from_set.orientation) * hit->normal);
    return;
  }
  const SolidTriangle& solid = triangles_[candidate - shapes_.size()];
  const int whose = body >= 0 ? body : solid.body;
  if (whose == ignored_body) return;
  const auto hit = CastAtTriangle({ray.origin, ray.direction, nearest.distance},
                                  {solid.corner, solid.edge1, solid.edge2});
  if (hit) nearest.Offer(hit->distance, whose, solid.primitive, hit->normal);
}

void SolidSet::Cast(const Ray& ray, int ignored_body, Nearest& nearest, int body) const {
  for (const SolidShape& plane : planes_) {
    const int whose = body >= 0 ? body : plane.body;
    if (whose == ignored_body) continue;
    const auto hit = CastAtShape(Moved(plane.shape_from_set, ray, nearest.distance), plane.shape);
    if (!hit) continue;
    nearest.Offer(hit->distance, whose, plane.primitive,
                  Inverse(plane.shape_from_set.orientation) * hit->normal);
  }
  if (tree_ == nullptr) {
    const auto count = static_cast<std::uint32_t>(shapes_.size() + triangles_.size());
    for (std::uint32_t i = 0; i < count; ++i) CastAt(i, ray, ignored_body, body, nearest);
    return;
  }
  struct Visitor final : BoxTree::Visitor {
    const SolidSet& set;
    const Ray& ray;
    int ignored_body, body;
    Nearest& nearest;
    Visitor(const SolidSet& s, const Ray& r, int ignored, int b, Nearest& n)
        : set(s), ray(r), ignored_body(ignored), body(b), nearest(n) {}
    double Visit(std::uint32_t candidate) override {
      set.CastAt(candidate, ray, ignored_body, body, nearest);
      return nearest.distance;
    }
  };
  Visitor visitor(*this, ray, ignored_body, body, nearest);
  tree_->Cast({ray.origin, ray.direction, nearest.distance}, visitor);
}

}  // namespace gsv::sensing
