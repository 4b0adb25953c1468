#include "gsv/geometry/shape.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "gsv/base/check.h"
#include "gsv/geometry/constants.h"

namespace gsv::geometry {
namespace {

// A point of a profile. A profile is a curve in the half-plane of radius (the distance from the z
// axis) and z. Its rotation about z makes a surface. `normal_out` and `normal_up` are the surface
// normal's components along radius and z. `v` is the vertical texture coordinate.
struct ProfilePoint {
  double radius = 0, z = 0;
  double normal_out = 0, normal_up = 0;
  double v = 0;
};

void AddVertex(const Vector3& position, const Vector3& normal, const Vector2& uv,
               TriangleMesh& mesh) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.texture_coordinates.push_back(uv);
}

std::uint32_t NextVertex(const TriangleMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.positions.size());
}

Vector2 Direction(int step, int segments) {
  // The last angle equals the first one bit by bit, so that the surface is closed at the seam.
  const double angle = 2 * kPi * (step % segments) / segments;
  return {std::cos(angle), std::sin(angle)};
}

// Adds the surface of a profile that is rotated about z. The profile must be given from bottom to
// top. At a profile point with radius 0, the surface ends in a point.
void AddRevolution(std::span<const ProfilePoint> profile, int segments, TriangleMesh& mesh) {
  const std::uint32_t first = NextVertex(mesh);
  const auto columns = static_cast<std::uint32_t>(segments) + 1;
  for (const ProfilePoint& p : profile) {
    for (int i = 0; i <= segments; ++i) {
      const Vector2 d = Direction(i, segments);
      AddVertex({p.radius * d.x, p.radius * d.y, p.z},
                {p.normal_out * d.x, p.normal_out * d.y, p.normal_up},
                {static_cast<double>(i) / segments, p.v}, mesh);
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t below = first + ring * columns + i, above = below + columns;
      if (profile[ring].radius > 0) mesh.triangles.push_back({below, below + 1, above + 1});
      if (profile[ring + 1].radius > 0) mesh.triangles.push_back({below, above + 1, above});
    }
  }
}

// Adds a disc at height z that faces up (+1) or down (-1).
void AddDisc(double radius, double z, int facing, int segments, TriangleMesh& mesh) {
  const std::uint32_t centre = NextVertex(mesh);
  const Vector3 normal{0, 0, static_cast<double>(facing)};
  AddVertex({0, 0, z}, normal, {0.5, 0.5}, mesh);
  for (int i = 0; i < segments; ++i) {
    const Vector2 d = Direction(i, segments);
    AddVertex({radius * d.x, radius * d.y, z}, normal, {0.5 + 0.5 * facing * d.x, 0.5 + 0.5 * d.y},
              mesh);
  }
  const auto count = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = centre + 1 + i, b = centre + 1 + (i + 1) % count;
    if (facing > 0) {
      mesh.triangles.push_back({centre, a, b});
    } else {
      mesh.triangles.push_back({centre, b, a});
    }
  }
}

// Adds a rectangle. `right` and `up` are half its width and half its height, for a viewer who looks
// at its front.
void AddRectangle(const Vector3& centre, const Vector3& right, const Vector3& up,
                  const Vector3& normal, TriangleMesh& mesh) {
  const std::uint32_t first = NextVertex(mesh);
  AddVertex(centre - right - up, normal, {0, 0}, mesh);
  AddVertex(centre + right - up, normal, {1, 0}, mesh);
  AddVertex(centre + right + up, normal, {1, 1}, mesh);
  AddVertex(centre - right + up, normal, {0, 1}, mesh);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

// Returns points of a circular arc in the profile's half-plane. The centre is (0, centre_z). The
// arc goes from the latitude `from` to the latitude `to` (rad); the points include both ends.
std::vector<ProfilePoint> Arc(double radius, double centre_z, double from, double to, int steps) {
  std::vector<ProfilePoint> points;
  for (int i = 0; i <= steps; ++i) {
    const double latitude = from + (to - from) * i / steps;
    const bool pole = std::abs(std::abs(latitude) - kPi / 2) < 1e-9;
    const double out = pole ? 0.0 : std::cos(latitude), up = std::sin(latitude);
    points.push_back({radius * out, centre_z + radius * up, out, up, 0});
  }
  return points;
}

// Sets `v` in proportion to the distance along the profile: 0 at its start, 1 at its end.
void SpreadTexture(std::vector<ProfilePoint>& profile) {
  double length = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    length +=
        std::hypot(profile[i].radius - profile[i - 1].radius, profile[i].z - profile[i - 1].z);
    profile[i].v = length;
  }
  if (length <= 0) return;
  for (ProfilePoint& p : profile) p.v /= length;
}

// Returns the two half axes of a plane's rectangle. They are along x and y if the normal is z.
std::pair<Vector3, Vector3> HalfAxes(const Plane& plane) {
  const Vector3 n = Normalized(plane.normal);
  const Vector3 z{0, 0, 1};
  // Rotate by the smallest rotation from z to the normal. If the normal is -z, rotate by half a
  // turn about x.
  const Quaternion turn = n.z < -1 + 1e-12
                              ? Quaternion{0, 1, 0, 0}
                              : Normalized(Quaternion{1 + n.z, Cross(z, n).x, Cross(z, n).y, 0});
  return {turn * Vector3{plane.size.x / 2, 0, 0}, turn * Vector3{0, plane.size.y / 2, 0}};
}

struct Tessellator {
  int segments;
  TriangleMesh mesh;

  int quarter() const { return std::max(1, (segments + 3) / 4); }

  void operator()(const Box& box) {
    const Vector3 half = 0.5 * box.size;
    for (const Vector3& n : {Vector3{1, 0, 0}, Vector3{-1, 0, 0}, Vector3{0, 1, 0},
                             Vector3{0, -1, 0}, Vector3{0, 0, 1}, Vector3{0, 0, -1}}) {
      const Vector3 up = n.z == 0 ? Vector3{0, 0, 1} : Vector3{0, 1, 0};
      AddRectangle(Scaled(n, half), Scaled(Cross(up, n), half), Scaled(up, half), n, mesh);
    }
  }

  void operator()(const Sphere& sphere) {
    std::vector<ProfilePoint> profile = Arc(sphere.radius, 0, -kPi / 2, kPi / 2, 2 * quarter());
    SpreadTexture(profile);
    AddRevolution(profile, segments, mesh);
  }

  void operator()(const Ellipsoid& ellipsoid) {
    (*this)(Sphere{1});
    const Vector3& r = ellipsoid.radii;
    for (Vector3& p : mesh.positions) p = Scaled(p, r);
    for (Vector3& n : mesh.normals) n = Normalized(Scaled(n, {r.y * r.z, r.x * r.z, r.x * r.y}));
  }

  void operator()(const Cylinder& cylinder) {
    const double half = cylinder.length / 2;
    const ProfilePoint side[] = {{cylinder.radius, -half, 1, 0, 0},
                                 {cylinder.radius, half, 1, 0, 1}};
    AddRevolution(side, segments, mesh);
    AddDisc(cylinder.radius, half, 1, segments, mesh);
    AddDisc(cylinder.radius, -half, -1, segments, mesh);
  }

  void operator()(const Capsule& capsule) {
    const double half = capsule.length / 2;
    std::vector<ProfilePoint> profile = Arc(capsule.radius, -half, -kPi / 2, 0, quarter());
    const std::vector<ProfilePoint> top = Arc(capsule.radius, half, 0, kPi / 2, quarter());
    profile.insert(profile.end(), top.begin(), top.end());
    SpreadTexture(profile);
    AddRevolution(profile, segments, mesh);
  }

  void operator()(const Cone& cone) {
    const double half = cone.length / 2, slant = std::hypot(cone.radius, cone.length);
    const double out = slant > 0 ? cone.length / slant : 1,
                 up = slant > 0 ? cone.radius / slant : 0;
    const ProfilePoint side[] = {{cone.radius, -half, out, up, 0}, {0, half, out, up, 1}};
    AddRevolution(side, segments, mesh);
    AddDisc(cone.radius, -half, -1, segments, mesh);
  }

  void operator()(const Plane& plane) {
    const auto [right, up] = HalfAxes(plane);
    AddRectangle({}, right, up, Normalized(plane.normal), mesh);
  }

  void operator()(const Mesh& shape) {
    mesh = *shape.triangles;
    const Vector3& s = shape.scale;
    const double mirrored = s.x * s.y * s.z < 0 ? -1 : 1;
    // Normals are transformed with the cofactors of the scale matrix, because they must stay
    // perpendicular to a stretched surface.
    const Vector3 cofactors = mirrored * Vector3{s.y * s.z, s.x * s.z, s.x * s.y};
    for (Vector3& p : mesh.positions) p = Scaled(p, s);
    for (Vector3& n : mesh.normals) n = Normalized(Scaled(n, cofactors));
    if (mirrored > 0) return;
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
};

Bounds Symmetric(const Vector3& half) { return {-half, half}; }

struct BoundsVisitor {
  Bounds operator()(const Box& s) const { return Symmetric(0.5 * s.size); }
  Bounds operator()(const Sphere& s) const { return Symmetric({s.radius, s.radius, s.radius}); }
  Bounds operator()(const Cylinder& s) const {
    return Symmetric({s.radius, s.radius, s.length / 2});
  }
  Bounds operator()(const Capsule& s) const {
    return Symmetric({s.radius, s.radius, s.length / 2 + s.radius});
  }
  Bounds operator()(const Ellipsoid& s) const { return Symmetric(s.radii); }
  Bounds operator()(const Cone& s) const { return Symmetric({s.radius, s.radius, s.length / 2}); }
  Bounds operator()(const Plane& s) const {
    const auto [right, up] = HalfAxes(s);
    return Symmetric({std::abs(right.x) + std::abs(up.x), std::abs(right.y) + std::abs(up.y),
                      std::abs(right.z) + std::abs(up.z)});
  }
  Bounds operator()(const Mesh& s) const {
    const Bounds b = BoundsOf(*s.triangles);
    const Vector3 p = Scaled(b.min, s.scale), q = Scaled(b.max, s.scale);
    return {{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)},
            {std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)}};
  }
};

}  // namespace

TriangleMesh Tessellate(const Shape& shape, int segments) {
  GSV_CHECK(segments >= 3);
  Tessellator tessellator{segments, {}};
  std::visit(tessellator, shape);
  TriangleMesh& mesh = tessellator.mesh;
  if (mesh.parts.empty() && !mesh.triangles.empty()) {
    mesh.parts.push_back({"", 0, static_cast<std::uint32_t>(mesh.triangles.size()), 0});
  }
  return std::move(mesh);
}

Bounds BoundsOf(const Shape& shape) { return std::visit(BoundsVisitor{}, shape); }

}  // namespace gsv::geometry
