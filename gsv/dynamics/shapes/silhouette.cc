#include "gsv/dynamics/shapes/silhouette.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "gsv/base/check.h"
#include "gsv/geometry/box_corners.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Shape;
using geometry::TriangleMesh;
using geometry::Vector3;

// A shape is upright if the sine of the angle between its axis and the vertical is less than this.
constexpr double kUpright = 1e-9;
// A shape that overlaps a slice by less than this is not in it.
constexpr double kTouching = 1e-9;
constexpr int kSegments = 32;

// The extent of a shape from its centre, in a direction in its own frame.
struct Reach {
  Vector3 d;

  double operator()(const geometry::Box& box) const {
    return (std::abs(d.x) * box.size.x + std::abs(d.y) * box.size.y + std::abs(d.z) * box.size.z) /
           2;
  }
  double operator()(const geometry::Sphere& sphere) const { return sphere.radius; }
  double operator()(const geometry::Cylinder& c) const {
    return c.radius * std::sqrt(d.x * d.x + d.y * d.y) + std::abs(d.z) * c.length / 2;
  }
  double operator()(const geometry::Capsule& c) const {
    return c.radius + std::abs(d.z) * c.length / 2;
  }
  double operator()(const geometry::Ellipsoid& e) const { return Norm(Scaled(d, e.radii)); }
  double operator()(const geometry::Cone& c) const {
    return std::max(d.z * c.length / 2,
                    c.radius * std::sqrt(d.x * d.x + d.y * d.y) - d.z * c.length / 2);
  }
  double operator()(const geometry::Plane&) const {
    GSV_CHECK(!"a plane is infinite");
    return 0;
  }
  double operator()(const geometry::Mesh& mesh) const {
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vector3& p : mesh.triangles->positions) {
      reach = std::max(reach, Dot(d, Scaled(p, mesh.scale)));
    }
    return mesh.triangles->positions.empty() ? 0 : reach;
  }
};

double ReachInto(const Shape& shape, const Pose& pose, const Vector3& direction) {
  return Dot(direction, pose.position) +
         std::visit(Reach{Inverse(pose.orientation) * direction}, shape);
}

Vector2 Flat(const Vector3& v) { return {v.x, v.y}; }

bool IsUpright(const Vector3& axis) {
  return std::sqrt(axis.x * axis.x + axis.y * axis.y) < kUpright;
}

std::vector<Vector2> Corners(const Shape& shape, const Pose& pose) {
  std::vector<Vector2> corners;
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    for (const Vector3& p : mesh->triangles->positions) {
      corners.push_back(Flat(pose * Scaled(p, mesh->scale)));
    }
    if (corners.empty()) corners.push_back(Flat(pose.position));
  } else if (std::holds_alternative<geometry::Box>(shape)) {
    for (const Vector3& corner : geometry::CornersOf(geometry::BoundsOf(shape))) {
      corners.push_back(Flat(pose * corner));
    }
  }
  return corners;
}

// Returns the largest radius of the shape between two heights above its centre, if it is a solid of
// revolution about the vertical. Negative for other shapes.
double UprightRadius(const Shape& shape, const Pose& pose, Interval h) {
  const Vector3 axis = pose.orientation * Vector3{0, 0, 1};
  const double nearest = std::clamp(0.0, h.low, h.high);
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    return std::sqrt(std::max(0.0, sphere->radius * sphere->radius - nearest * nearest));
  }
  if (!IsUpright(axis)) return -1;
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) return cylinder->radius;
  if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) {
    const double beyond = std::max(0.0, std::abs(nearest) - capsule->length / 2);
    return std::sqrt(std::max(0.0, capsule->radius * capsule->radius - beyond * beyond));
  }
  if (const auto* cone = std::get_if<geometry::Cone>(&shape)) {
    const double base_at = axis.z > 0 ? -cone->length / 2 : cone->length / 2;
    const double to_base = std::abs(std::clamp(base_at, h.low, h.high) - base_at);
    return cone->radius * std::max(0.0, 1 - to_base / cone->length);
  }
  if (const auto* ellipsoid = std::get_if<geometry::Ellipsoid>(&shape)) {
    if (ellipsoid->radii.x != ellipsoid->radii.y) return -1;
    const double part = nearest / ellipsoid->radii.z;
    return ellipsoid->radii.x * std::sqrt(std::max(0.0, 1 - part * part));
  }
  return -1;
}

// Returns the shape, enlarged so that its tessellation encloses the original shape.
Shape Widened(Shape shape) {
  const double wider = 1 / std::cos(std::numbers::pi / kSegments);
  if (auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) cylinder->radius *= wider;
  if (auto* cone = std::get_if<geometry::Cone>(&shape)) cone->radius *= wider;
  if (auto* capsule = std::get_if<geometry::Capsule>(&shape)) capsule->radius *= wider * wider;
  if (auto* ellipsoid = std::get_if<geometry::Ellipsoid>(&shape)) ellipsoid->radii *= wider * wider;
  return shape;
}

// The part of a triangle between two heights: at most five corners.
struct Clipped {
  std::array<Vector3, 8> corners;
  int count = 0;
};

// Keeps the corners where sign * z >= sign * height, and adds corners where edges cross this
// height.
Clipped ClipAt(const Clipped& polygon, double height, double sign) {
  Clipped kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vector3& a = polygon.corners[i];
    const Vector3& b = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
    const double above_a = sign * (a.z - height), above_b = sign * (b.z - height);
    if (above_a >= 0) kept.corners[kept.count++] = a;
    if ((above_a > 0 && above_b < 0) || (above_a < 0 && above_b > 0)) {
      kept.corners[kept.count++] = a + (above_a / (above_a - above_b)) * (b - a);
    }
  }
  return kept;
}

Clipped ClipTriangle(const std::array<Vector3, 3>& triangle, Interval heights) {
  Clipped polygon;
  const auto [low, high] = std::minmax({triangle[0].z, triangle[1].z, triangle[2].z});
  if (high <= heights.low + kTouching || low >= heights.high - kTouching) return polygon;
  std::copy(triangle.begin(), triangle.end(), polygon.corners.begin());
  polygon.count = 3;
  return ClipAt(ClipAt(polygon, heights.low, 1), heights.high, -1);
}

// Calls `visit` with the part of each triangle between the heights.
template <typename Visit>
void ForEachClipped(const TriangleMesh& mesh, const Vector3& scale, const Pose& pose,
                    Interval heights, Visit visit) {
  for (const auto& triangle : mesh.triangles) {
    const Clipped clipped = ClipTriangle({pose * Scaled(mesh.positions[triangle[0]], scale),
                                          pose * Scaled(mesh.positions[triangle[1]], scale),
                                          pose * Scaled(mesh.positions[triangle[2]], scale)},
                                         heights);
    if (clipped.count > 0) visit(clipped);
  }
}

void SliceMesh(const geometry::Mesh& mesh, const Pose& pose, Interval heights,
               std::vector<ConvexPiece>& pieces) {
  ForEachClipped(*mesh.triangles, mesh.scale, pose, heights, [&](const Clipped& clipped) {
    std::vector<Vector2> corners;
    corners.reserve(static_cast<std::size_t>(clipped.count));
    for (int i = 0; i < clipped.count; ++i) corners.push_back(Flat(clipped.corners[i]));
    pieces.push_back(Hull(std::move(corners)));
  });
}

}  // namespace

Interval Heights(const Shape& shape, const Pose& pose) {
  return {-ReachInto(shape, pose, {0, 0, -1}), ReachInto(shape, pose, {0, 0, 1})};
}

ConvexPiece Silhouette(const Shape& shape, const Pose& pose) {
  constexpr double kFar = std::numeric_limits<double>::max();
  const double radius = UprightRadius(shape, pose, {-kFar, kFar});
  if (radius >= 0) return Disc(Flat(pose.position), radius);
  if (std::vector<Vector2> corners = Corners(shape, pose); !corners.empty()) {
    return Hull(std::move(corners));
  }
  const Vector3 axis = pose.orientation * Vector3{0, 0, 1};
  if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) {
    const Vector3 half = (capsule->length / 2) * axis;
    ConvexPiece stadium = Hull({Flat(pose.position - half), Flat(pose.position + half)});
    stadium.radius = capsule->radius;
    return stadium;
  }
  return PolygonAround(
      [&](Vector2 d) {
        return ReachInto(shape, pose, {d.x, d.y, 0});
      },
      std::atan2(axis.y, axis.x));
}

void Slice(const Shape& shape, const Pose& pose, Interval heights,
           std::vector<ConvexPiece>& pieces) {
  if (std::holds_alternative<geometry::Plane>(shape)) return;
  const Interval own = Heights(shape, pose);
  if (own.high <= heights.low + kTouching || own.low >= heights.high - kTouching) return;
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    SliceMesh(*mesh, pose, heights, pieces);
    return;
  }
  const double radius =
      UprightRadius(shape, pose, {heights.low - pose.position.z, heights.high - pose.position.z});
  if (radius >= 0) {
    pieces.push_back(Disc(Flat(pose.position), radius));
  } else if (own.low >= heights.low && own.high <= heights.high) {
    pieces.push_back(Silhouette(shape, pose));
  } else {
    std::vector<Vector2> corners;
    ForEachClipped(geometry::Tessellate(Widened(shape), kSegments), {1, 1, 1}, pose, heights,
                   [&](const Clipped& clipped) {
                     for (int i = 0; i < clipped.count; ++i)
                       corners.push_back(Flat(clipped.corners[i]));
                   });
    if (!corners.empty()) pieces.push_back(Hull(std::move(corners)));
  }
}

}  // namespace gsv::dynamics
