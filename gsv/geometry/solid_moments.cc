#include "gsv/geometry/solid_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gsv::geometry {
namespace {

using std::numbers::pi;

// Returns the moments of a solid that is symmetric in each axis, so that xy, xz and yz are 0. The
// arguments `xx`, `yy` and `zz` are the second moments divided by the volume.
SolidMoments Symmetric(double volume, const Vector3& centroid, double xx, double yy, double zz) {
  SolidMoments moments;
  moments.volume = volume;
  moments.centroid = centroid;
  moments.xx = volume * xx, moments.yy = volume * yy, moments.zz = volume * zz;
  return moments;
}

SolidMoments Of(const Box& box) {
  const Vector3& s = box.size;
  return Symmetric(s.x * s.y * s.z, {}, s.x * s.x / 12, s.y * s.y / 12, s.z * s.z / 12);
}

SolidMoments Of(const Ellipsoid& ellipsoid) {
  const Vector3& r = ellipsoid.radii;
  return Symmetric(4 * pi / 3 * r.x * r.y * r.z, {}, r.x * r.x / 5, r.y * r.y / 5, r.z * r.z / 5);
}

SolidMoments Of(const Sphere& sphere) {
  return Of(Ellipsoid{{sphere.radius, sphere.radius, sphere.radius}});
}

SolidMoments Of(const Cylinder& cylinder) {
  const double r = cylinder.radius, l = cylinder.length;
  return Symmetric(pi * r * r * l, {}, r * r / 4, r * r / 4, l * l / 12);
}

// A capsule is a cylinder between two hemispheres. The distance between the centroid of a
// hemisphere and the end face of the cylinder is 3/8 of the radius.
SolidMoments Of(const Capsule& capsule) {
  const double r = capsule.radius, l = capsule.length;
  const SolidMoments middle = Of(Cylinder{r, l}), ball = Of(Sphere{r});
  SolidMoments both;
  both.volume = middle.volume + ball.volume;
  both.xx = both.yy = middle.xx + ball.xx;
  both.zz = middle.zz + ball.zz + ball.volume * (l * l / 4 + 3 * r * l / 8);
  return both;
}

SolidMoments Of(const Cone& cone) {
  const double r = cone.radius, l = cone.length;
  return Symmetric(pi * r * r * l / 3, {0, 0, -l / 4}, 3 * r * r / 20, 3 * r * r / 20,
                   3 * l * l / 80);
}

SolidMoments Of(const Plane&) { return {}; }

// The tetrahedron has the volume V, one corner at the origin, and three other corners v. The
// integral of x_i x_j is V/20 (sum of v_i v_j + (sum of v_i) (sum of v_j)). Each sum is over the
// three corners v.
void AddTetrahedron(const Vector3& a, const Vector3& b, const Vector3& c, SolidMoments& sum) {
  const double volume = Dot(a, Cross(b, c)) / 6;
  const Vector3 total = a + b + c;
  const auto product = [&](double Vector3::*i, double Vector3::*j) {
    return volume / 20 * (a.*i * a.*j + b.*i * b.*j + c.*i * c.*j + total.*i * total.*j);
  };
  sum.volume += volume;
  sum.centroid += volume / 4 * total;
  sum.xx += product(&Vector3::x, &Vector3::x);
  sum.yy += product(&Vector3::y, &Vector3::y);
  sum.zz += product(&Vector3::z, &Vector3::z);
  sum.xy += product(&Vector3::x, &Vector3::y);
  sum.xz += product(&Vector3::x, &Vector3::z);
  sum.yz += product(&Vector3::y, &Vector3::z);
}

SolidMoments Of(const Mesh& mesh) {
  const auto& positions = mesh.triangles->positions;
  // Positions are relative to the first corner, so that a mesh far from its origin loses no digits.
  const Vector3 origin = positions.empty() ? Vector3{} : Scaled(positions[0], mesh.scale);
  SolidMoments sum;
  for (const auto& t : mesh.triangles->triangles) {
    const auto corner = [&](int i) { return Scaled(positions[t[i]], mesh.scale) - origin; };
    AddTetrahedron(corner(0), corner(1), corner(2), sum);
  }
  if (sum.volume == 0) return {};
  // If the volume is negative, the normals of the mesh point inwards, or the mesh is mirrored. Then
  // all integrals have the wrong sign.
  const double sign = sum.volume < 0 ? -1 : 1;
  const Vector3 c = 1 / sum.volume * sum.centroid;
  SolidMoments moments;
  moments.volume = sign * sum.volume;
  moments.centroid = origin + c;
  moments.xx = sign * (sum.xx - sum.volume * c.x * c.x);
  moments.yy = sign * (sum.yy - sum.volume * c.y * c.y);
  moments.zz = sign * (sum.zz - sum.volume * c.z * c.z);
  moments.xy = sign * (sum.xy - sum.volume * c.x * c.y);
  moments.xz = sign * (sum.xz - sum.volume * c.x * c.z);
  moments.yz = sign * (sum.yz - sum.volume * c.y * c.z);
  return moments;
}

void AddBelow(const Vector3& a, const Vector3& b, const Vector3& c, VolumeBelow& sum) {
  const double volume = Dot(a, Cross(b, c)) / 6;
  sum.volume += volume;
  sum.first_moment += volume / 4 * (a + b + c);
}

}  // namespace

SolidMoments MomentsOf(const Shape& shape) {
  return std::visit([](const auto& solid) { return Of(solid); }, shape);
}

VolumeBelow BelowHeight(const TriangleMesh& mesh, const Pose& world_from_mesh, double height) {
  // Positions are relative to a point in the cutting plane. Then the tetrahedra between this point
  // and the cut face have no volume, and need not be added.
  const Vector3 origin{world_from_mesh.position.x, world_from_mesh.position.y, height};
  VolumeBelow sum;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector3, 4> kept;
    std::size_t count = 0;
    for (int i = 0; i < 3; ++i) {
      const Vector3 from = world_from_mesh * mesh.positions[triangle[i]] - origin;
      const Vector3 to = world_from_mesh * mesh.positions[triangle[(i + 1) % 3]] - origin;
      if (from.z <= 0) kept[count++] = from;
      if ((from.z <= 0) != (to.z <= 0)) {
        kept[count++] = from + from.z / (from.z - to.z) * (to - from);
      }
    }
    for (std::size_t i = 2; i < count; ++i) AddBelow(kept[0], kept[i - 1], kept[i], sum);
  }
  sum.first_moment += sum.volume * origin;
  return sum;
}

VolumeBelow SphereBelowHeight(double radius, const Vector3& centre, double height) {
  const double depth = std::clamp(height - (centre.z - radius), 0.0, 2 * radius);
  if (depth == 0) return {};
  const double volume = pi * depth * depth * (radius - depth / 3);
  const double rest = 2 * radius - depth;
  const double below_centre = 3 * rest * rest / (4 * (3 * radius - depth));
  return {volume, volume * (centre - Vector3{0, 0, below_centre})};
}

}  // namespace gsv::geometry
