#include "gsv/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gsv::geometry {
namespace {

// Returns the distance from a point to a rectangle; negative inside. `outside_x` is the distance by
// which the point lies beyond the nearer of the two sides at the ends of the x axis. It is negative
// if the point lies between these sides. `outside_y` is the same for y.
double ToRectangle(double outside_x, double outside_y) {
  const double beyond = std::hypot(std::max(outside_x, 0.0), std::max(outside_y, 0.0));
  return beyond + std::min(std::max(outside_x, outside_y), 0.0);
}

double To(const Box& box, const Vector3& p) {
  const double x = std::abs(p.x) - box.size.x / 2, y = std::abs(p.y) - box.size.y / 2,
               z = std::abs(p.z) - box.size.z / 2;
  const Vector3 beyond{std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)};
  return Norm(beyond) + std::min(std::max({x, y, z}), 0.0);
}

double To(const Sphere& sphere, const Vector3& p) { return Norm(p) - sphere.radius; }

double To(const Cylinder& cylinder, const Vector3& p) {
  return ToRectangle(std::hypot(p.x, p.y) - cylinder.radius, std::abs(p.z) - cylinder.length / 2);
}

double To(const Capsule& capsule, const Vector3& p) {
  const double nearest = std::clamp(p.z, -capsule.length / 2, capsule.length / 2);
  return Norm(p - Vector3{0, 0, nearest}) - capsule.radius;
}

double To(const Ellipsoid& ellipsoid, const Vector3& p) {
  const Vector3 inverse{1 / ellipsoid.radii.x, 1 / ellipsoid.radii.y, 1 / ellipsoid.radii.z};
  const Vector3 scaled = Scaled(p, inverse);
  const double length = Norm(scaled), slope = Norm(Scaled(scaled, inverse));
  if (slope == 0) {
    return -std::min({ellipsoid.radii.x, ellipsoid.radii.y, ellipsoid.radii.z});
  }
  return length * (length - 1) / slope;
}

double ToSegment(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a, from_a = p - a;
  const double squared = along.x * along.x + along.y * along.y;
  const double t =
      squared > 0 ? std::clamp((from_a.x * along.x + from_a.y * along.y) / squared, 0.0, 1.0) : 0;
  return std::hypot(from_a.x - t * along.x, from_a.y - t * along.y);
}

// In the plane of (distance from the axis, height), the cone is a triangle.
double To(const Cone& cone, const Vector3& p) {
  const Vector2 point{std::hypot(p.x, p.y), p.z};
  const Vector2 centre{0, -cone.length / 2}, rim{cone.radius, -cone.length / 2},
      apex{0, cone.length / 2};
  const double distance = std::min(ToSegment(point, centre, rim), ToSegment(point, rim, apex));
  const double side = cone.length * (point.x - cone.radius) + cone.radius * (point.y - centre.y);
  return point.y > centre.y && side < 0 ? -distance : distance;
}

double To(const Plane& plane, const Vector3& p) { return Dot(plane.normal, p); }

Vector3 NearestOn(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
  const Vector3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = Dot(ab, ap), d2 = Dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3 bp = p - b;
  const double d3 = Dot(ab, bp), d4 = Dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return a + (d1 / (d1 - d3)) * ab;
  const Vector3 cp = p - c;
  const double d5 = Dot(ab, cp), d6 = Dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  const double along_b = d4 - d3, along_c = d5 - d6;
  if (va <= 0 && along_b >= 0 && along_c >= 0 && along_b + along_c > 0) {
    return b + (along_b / (along_b + along_c)) * (c - b);
  }
  const double sum = va + vb + vc;
  if (sum == 0) return a;  // the triangle has no area
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

double To(const Mesh& mesh, const Vector3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto& positions = mesh.triangles->positions;
  for (const auto& corners : mesh.triangles->triangles) {
    const Vector3 a = Scaled(positions[corners[0]], mesh.scale);
    const Vector3 b = Scaled(positions[corners[1]], mesh.scale);
    const Vector3 c = Scaled(positions[corners[2]], mesh.scale);
    nearest = std::min(nearest, Norm(p - NearestOn(a, b, c, p)));
  }
  return nearest;
}

}  // namespace

double DistanceTo(const Shape& shape, const Vector3& point) {
  return std::visit([&](const auto& each) { return To(each, point); }, shape);
}

}  // namespace gsv::geometry
