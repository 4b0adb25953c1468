#include "gsv/rendering/raster/surface.h"

#include <algorithm>
#include <cmath>

#include "gsv/rendering/raster/raster_texture.h"

namespace gsv::rendering::raster {

TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& t) {
  constexpr int kNormal = TriangleSurface::kNormalX;
  const RasterMesh& mesh = *drawn.mesh;
  const I8 is_normal{0, 0, 0, -1, -1, -1, 0, 0};
  const F8 columns[3] = {Load(drawn.normal[0]), Load(drawn.normal[1]), Load(drawn.normal[2])};
  F8 corners[3];  // the attributes of the three corners
  for (int i = 0; i < 3; ++i) {
    const float* of = mesh.attributes[t.corner[i]].values;
    const F8 normal = columns[0] * Splat(of[kNormal]) + columns[1] * Splat(of[kNormal + 1]) +
                      columns[2] * Splat(of[kNormal + 2]);
    corners[i] = Select(is_normal, normal, Load(of));
  }
  TriangleSurface s;
  const auto store = [&](const float(&weights)[3], float(&to)[8]) {
    Store(to, Splat(weights[0]) * corners[0] + Splat(weights[1]) * corners[1] +
                  Splat(weights[2]) * corners[2]);
  };
  store(t.a, s.a), store(t.b, s.b), store(t.c, s.c);
  s.x0 = t.x0, s.y0 = t.y0;
  const I8 differs = ~((corners[0] == corners[1]) & (corners[0] == corners[2]));
  s.is_flat = !Any(differs & is_normal);
  if (s.is_flat) {
    float n[8];
    Store(n, corners[0]);
    const float* normal = n + kNormal;
    const float length =
        std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; ++k) {
      s.a[kNormal + k] = s.b[kNormal + k] = 0;
      s.c[kNormal + k] = normal[k] / std::max(length, 1e-20f);
    }
  }
  // Adjacent surfaces, and the same surface of two objects, get different 8-bit numbers.
  s.number =
      (97 * mesh.surface[t.corner[0]] + 57 * static_cast<int>(drawn.factors->surface)) % 255 + 1;
  return s;
}

// The axes follow from the triangle's edges (Schüler, "Followup: normal mapping without precomputed
// tangents", 2013).
BumpAxes BumpAxesOf(const Drawn& drawn, const Triangle& t) {
  const RasterMesh& mesh = *drawn.mesh;
  const auto edge = [&](int i) {
    const std::uint32_t from = t.corner[0], to = t.corner[i];
    const float x = mesh.x[to] - mesh.x[from], y = mesh.y[to] - mesh.y[from],
                z = mesh.z[to] - mesh.z[from];
    const auto& m = drawn.rows;
    return geometry::Vector3{m[0][0] * x + m[0][1] * y + m[0][2] * z,
                             m[1][0] * x + m[1][1] * y + m[1][2] * z,
                             m[2][0] * x + m[2][1] * y + m[2][2] * z};
  };
  const geometry::Vector3 e1 = edge(1), e2 = edge(2), plane = geometry::Cross(e1, e2);
  const geometry::Vector3 along_1 = geometry::Cross(e2, plane),
                          along_2 = geometry::Cross(plane, e1);
  const auto gradient = [&](TriangleSurface::Plane coordinate) {
    const auto at = [&](int i) { return mesh.attributes[t.corner[i]].values[coordinate]; };
    const double d1 = at(1) - at(0), d2 = at(2) - at(0);
    return d1 * along_1 + d2 * along_2;
  };
  const geometry::Vector3 right = gradient(TriangleSurface::kU),
                          down = gradient(TriangleSurface::kV);
  const double longest = std::max(geometry::Dot(right, right), geometry::Dot(down, down));
  BumpAxes axes;
  if (!(longest > 0)) return axes;
  axes.is_valid = true;
  const double k = 1 / std::sqrt(longest);
  const auto set = [&](const geometry::Vector3& a, float(&to)[3]) {
    to[0] = static_cast<float>(k * a.x);
    to[1] = static_cast<float>(k * a.y);
    to[2] = static_cast<float>(k * a.z);
  };
  set(right, axes.right);
  set(down, axes.down);
  return axes;
}

}  // namespace gsv::rendering::raster
