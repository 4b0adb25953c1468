#include "gsv/sensing/rays/solid_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "gsv/geometry/box_corners.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/ray_axis.h"
#include "gsv/sensing/rays/ray_shape.h"

namespace gsv::sensing {
namespace {

using geometry::kInfinity;

using geometry::Bounds;
using geometry::Pose;
using geometry::Shape;
using geometry::Vector3;

// If there are at most this many triangles, each of them is tested.
constexpr std::size_t kHandful = 6;

// Tolerance for the rounding errors of boxes and heights: a length times kPadding, plus kPadding
// metres.
constexpr double kPadding = 1e-9;

Bounds BoundsOfTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

// Returns the bounds of the rotated bounding box of the shape.
Bounds BoundsOfShape(const Shape& shape, const Pose& set_from_shape) {
  const std::array<Vector3, 8> corners = geometry::CornersOf(geometry::BoundsOf(shape));
  Bounds bounds{set_from_shape * corners[0], set_from_shape * corners[0]};
  for (const Vector3& corner : corners) {
    const Vector3 p = set_from_shape * corner;
    bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                  std::min(bounds.min.z, p.z)};
    bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                  std::max(bounds.max.z, p.z)};
  }
  return bounds;
}

Bounds Padded(const Bounds& b) {
  double furthest = 1;
  for (const double x : {b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z}) {
    furthest = std::max(furthest, std::abs(x));
  }
  const double by = kPadding * furthest;
  return {b.min - Vector3{by, by, by}, b.max + Vector3{by, by, by}};
}

BoundingSphere Padded(const BoundingSphere& ball) {
  return {ball.centre, ball.radius + kPadding * (1 + ball.radius + Norm(ball.centre))};
}

// Whether a part of the box is within the reach of the candidate set.
bool Reaches(const CandidateSet& candidates, const Bounds& box) {
  const Vector3& place = candidates.place();
  const auto gap = [](double low, double x, double high) {
    return std::max(std::max(low - x, x - high), 0.0);
  };
  const Vector3 gaps{gap(box.min.x, place.x, box.max.x), gap(box.min.y, place.y, box.max.y),
                     gap(box.min.z, place.z, box.max.z)};
  return Dot(gaps, gaps) <= candidates.reach() * candidates.reach();
}

// The extent of a shape from its origin.
struct Reach {
  double operator()(const geometry::Box& box) const { return 0.5 * Norm(box.size); }
  double operator()(const geometry::Sphere& sphere) const { return sphere.radius; }
  double operator()(const geometry::Capsule& c) const { return c.radius + c.length / 2; }
  double operator()(const geometry::Ellipsoid& e) const {
    return std::max({e.radii.x, e.radii.y, e.radii.z});
  }
  template <class Round>
  double operator()(const Round& round) const {  // cylinder, cone
    return std::hypot(round.radius, round.length / 2);
  }
  double operator()(const geometry::Plane&) const { return kInfinity; }
  double operator()(const geometry::Mesh&) const { return kInfinity; }
};

// Tests whether a ray hits a box. A ray also counts if it misses the box only by rounding errors.
class BoxTest {
 public:
  explicit BoxTest(const Ray& ray)
      : x_(ray.origin.x, ray.direction.x),
        y_(ray.origin.y, ray.direction.y),
        z_(ray.origin.z, ray.direction.z) {}

  bool operator()(const Bounds& box, double length) const {
    double begin = 0, end = length;
    x_.Clip(box.min.x, box.max.x, begin, end);
    y_.Clip(box.min.y, box.max.y, begin, end);
    z_.Clip(box.min.z, box.max.z, begin, end);
    return begin <= end;
  }

 private:
  RayAxis x_, y_, z_;
};

}  // namespace

void SolidSet::Add(const Shape& shape, const Pose& set_from_shape, int body, float reflectance) {
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    mesh_reflectances_.emplace_back(static_cast<std::uint32_t>(triangles_.size()), reflectance);
    AddMesh(*mesh, set_from_shape, body);
    return;
  }
  SolidShape solid{shape, Inverse(set_from_shape), primitives_++, body};
  if (const auto* plane = std::get_if<geometry::Plane>(&shape)) {
    const Vector3 normal = set_from_shape.orientation * plane->normal;
    plane_reflectances_.push_back(reflectance);
    planes_.push_back({std::move(solid), normal, Dot(normal, set_from_shape.position)});
    return;
  }
  const Bounds bounds = BoundsOfShape(shape, set_from_shape);
  Include(bounds);
  shape_bounds_.push_back(Padded(bounds));
  shape_spheres_.push_back(
      Padded(BoundingSphere{set_from_shape.position, std::visit(Reach{}, shape)}));
  shape_own_bounds_.push_back(geometry::BoundsOf(shape));
  shape_reflectances_.push_back(reflectance);
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

BoundingSphere SolidSet::ball() const {
  const Vector3 centre = 0.5 * (bounds_.min + bounds_.max);
  double furthest = 0;
  for (const BoundingSphere& ball : shape_spheres_) {
    furthest = std::max(furthest, Norm(ball.centre - centre) + ball.radius);
  }
  for (const SolidTriangle& t : triangles_) {
    for (const Vector3& corner : {t.corner, t.corner + t.edge1, t.corner + t.edge2}) {
      furthest = std::max(furthest, Norm(corner - centre));
    }
  }
  return Padded(BoundingSphere{centre, std::min(furthest, 0.5 * Norm(bounds_.max - bounds_.min))});
}

void SolidSet::Commit() {
  shape_index_.Build(shape_bounds_, /*often=*/false);
  shape_grid_.Build(shape_spheres_, shape_bounds_);
  if (triangles_.size() <= kHandful) return;
  std::vector<Bounds> boxes;
  boxes.reserve(triangles_.size());
  for (const SolidTriangle& t : triangles_) {
    boxes.push_back(BoundsOfTriangle(t.corner, t.corner + t.edge1, t.corner + t.edge2));
  }
  triangle_tree_ = std::make_unique<BoundingVolumeTree>();
  triangle_tree_->Build(boxes, /*often=*/false);
}

// With many robots that have sonars, casting rays at single shapes takes most of the time. So all
// calls in this function are inlined.
[[gnu::flatten]] void SolidSet::CastAt(const SolidShape& shape, std::uint32_t solid, const Ray& ray,
                                       int ignored_body, Nearest& nearest, const Bearer& bearer) {
  const int body = bearer.body >= 0 ? bearer.body : shape.body;
  if (body == ignored_body) return;
  const auto distance =
      DistanceToShape(Moved(shape.shape_from_set, ray, nearest.distance), shape.shape);
  if (!distance) return;
  nearest.Offer(*distance, body, bearer.first_primitive + shape.primitive, bearer.part, solid);
}

// Compares the height of the fan's origin over each plane with the largest height that a ray can
// lose along its length. Per metre, a ray loses at most the normal's component in the fan's plane
// plus the component that the elevation adds.
bool SolidSet::OthersReach(const Fan& fan) const {
  if (!triangles_.empty()) return true;
  for (const SolidPlane& plane : planes_) {
    const double height = std::abs(Dot(plane.normal, fan.world_from_fan.position) - plane.offset);
    const Vector3 normal = Inverse(fan.world_from_fan.orientation) * plane.normal;
    const double most = std::hypot(normal.x, normal.y) * std::abs(std::cos(fan.elevation)) +
                        std::abs(normal.z * std::sin(fan.elevation));
    const double climb = (most + kPadding) * fan.max_distance;
    if (!(climb + kPadding + kPadding * height < height)) return true;
  }
  return false;
}

void SolidSet::CastAtShape(std::uint32_t shape, const Ray& ray, int ignored_body, Nearest& nearest,
                           const Bearer& bearer) const {
  CastAt(shapes_[shape], shape, ray, ignored_body, nearest, bearer);
}

void SolidSet::CastAtShapes(const Ray& ray, int ignored_body, Nearest& nearest,
                            const Bearer& bearer) const {
  if (shapes_.empty()) return;
  if (shapes_.size() == 1) return CastAtShape(0, ray, ignored_body, nearest, bearer);
  const BoxTest passes(ray);
  shape_index_.Walk(ray, nearest.distance, [&](std::uint32_t i) {
    if (!passes(shape_bounds_[i], nearest.distance)) return;
    CastAtShape(i, ray, ignored_body, nearest, bearer);
  });
}

void SolidSet::CastAtPlanes(const Ray& ray, int ignored_body, Nearest& nearest,
                            const Bearer& bearer) const {
  for (std::uint32_t i = 0; i < planes_.size(); ++i) {
    const SolidPlane& plane = planes_[i];
    const double height = std::abs(Dot(plane.normal, ray.origin) - plane.offset);
    const double climb = std::abs(Dot(plane.normal, ray.direction)) * nearest.distance;
    if (climb + kPadding + kPadding * height < height) continue;
    CastAt(plane.solid, static_cast<std::uint32_t>(shapes_.size()) + i, ray, ignored_body, nearest,
           bearer);
  }
}

void SolidSet::CastAtTriangles(const Ray& ray, int ignored_body, Nearest& nearest,
                               const Bearer& bearer) const {
  const auto first = static_cast<std::uint32_t>(shapes_.size() + planes_.size());
  const auto cast_at = [&](std::uint32_t i) {
    const SolidTriangle& t = triangles_[i];
    const int body = bearer.body >= 0 ? bearer.body : t.body;
    if (body == ignored_body) return;
    const auto distance = DistanceToTriangle({ray.origin, ray.direction, nearest.distance},
                                             {t.corner, t.edge1, t.edge2});
    if (!distance) return;
    nearest.Offer(*distance, body, bearer.first_primitive + t.primitive, bearer.part, first + i);
  };
  if (triangle_tree_ == nullptr) {
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) cast_at(i);
  } else {
    triangle_tree_->Find(ray, nearest.distance, cast_at);
  }
}

void SolidSet::CastAtOthers(const Ray& ray, int ignored_body, Nearest& nearest,
                            const Bearer& bearer) const {
  if (!planes_.empty()) CastAtPlanes(ray, ignored_body, nearest, bearer);
  if (!triangles_.empty()) CastAtTriangles(ray, ignored_body, nearest, bearer);
}

void SolidSet::Cast(const Ray& ray, int ignored_body, Nearest& nearest,
                    const Bearer& bearer) const {
  CastAtShapes(ray, ignored_body, nearest, bearer);
  CastAtOthers(ray, ignored_body, nearest, bearer);
}

bool SolidSet::Gather(CandidateSet& candidates, std::uint32_t mark) const {
  FoundBoxes found;
  if (!shape_index_.Near(candidates.place(), candidates.reach(), found)) return false;
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::uint32_t shape = found.boxes[i];
    candidates.Add(shape_spheres_[shape], mark | shape, Reaches(candidates, shape_bounds_[shape]));
  }
  return true;
}

float SolidSet::ReflectanceOf(std::uint32_t solid) const {
  if (solid < shapes_.size()) return shape_reflectances_[solid];
  solid -= static_cast<std::uint32_t>(shapes_.size());
  if (solid < planes_.size()) return plane_reflectances_[solid];
  solid -= static_cast<std::uint32_t>(planes_.size());
  const auto next = std::upper_bound(
      mesh_reflectances_.begin(), mesh_reflectances_.end(), solid,
      [](std::uint32_t triangle, const auto& mesh) { return triangle < mesh.first; });
  return std::prev(next)->second;
}

Vector3 SolidSet::NormalAt(std::uint32_t solid, const Ray& ray) const {
  if (solid >= shapes_.size() + planes_.size()) {
    const SolidTriangle& t = triangles_[solid - shapes_.size() - planes_.size()];
    return NormalOfTriangle(ray, {t.corner, t.edge1, t.edge2});
  }
  const SolidShape& at =
      solid < shapes_.size() ? shapes_[solid] : planes_[solid - shapes_.size()].solid;
  return Inverse(at.shape_from_set.orientation) *
         NormalOfShape(Moved(at.shape_from_set, ray, ray.max_distance), at.shape);
}

}  // namespace gsv::sensing
