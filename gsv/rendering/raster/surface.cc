#include "gsv/rendering/raster/surface.h"

#include <algorithm>
#include <cmath>

#include "gsv/rendering/raster/raster_texture.h"

namespace gsv::rendering::raster {
namespace {

// Approximates the binary logarithm of positive numbers from their exponent and fraction.
F4 Log2(F4 value) { return _mm_cvtepi32_ps((__m128i)value) * (1.0f / (1 << 23)) - 127; }

}  // namespace

TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& t) {
  const RasterMesh& mesh = *drawn.mesh;
  TriangleSurface s;
  float n[3][3];  // the normals of the three corners
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t v = t.corner[i];
    const float x = mesh.normal_x[v], y = mesh.normal_y[v], z = mesh.normal_z[v];
    for (int k = 0; k < 3; ++k) {
      n[i][k] = drawn.normal[k][0] * x + drawn.normal[k][1] * y + drawn.normal[k][2] * z;
    }
  }
  const auto plane = [&](float v0, float v1, float v2) {
    return TriangleSurface::Plane{t.a[0] * v0 + t.a[1] * v1 + t.a[2] * v2,
                                  t.b[0] * v0 + t.b[1] * v1 + t.b[2] * v2,
                                  t.c[0] * v0 + t.c[1] * v1 + t.c[2] * v2};
  };
  s.inverse_w = plane(1, 1, 1);
  s.is_flat = std::equal(n[0], n[0] + 3, n[1]) && std::equal(n[0], n[0] + 3, n[2]);
  const float length = std::sqrt(n[0][0] * n[0][0] + n[0][1] * n[0][1] + n[0][2] * n[0][2]);
  for (int k = 0; k < 3; ++k) {
    s.normal[k] = s.is_flat ? TriangleSurface::Plane{0, 0, n[0][k] / std::max(length, 1e-20f)}
                            : plane(n[0][k], n[1][k], n[2][k]);
  }
  s.u = plane(mesh.u[t.corner[0]], mesh.u[t.corner[1]], mesh.u[t.corner[2]]);
  s.v = plane(mesh.v[t.corner[0]], mesh.v[t.corner[1]], mesh.v[t.corner[2]]);
  // Adjacent surfaces, and the same surface of two objects, get different 8-bit numbers.
  s.number =
      (97 * mesh.surface[t.corner[0]] + 57 * static_cast<int>(drawn.factors->surface)) % 255 + 1;
  return s;
}

F4 LevelsAt(const TriangleSurface& s, F4 dx, float dy, const RasterTexture& texture) {
  const auto at = [&](const TriangleSurface::Plane& p) { return p.c + p.a * dx + p.b * dy; };
  const F4 inverse_w = at(s.inverse_w);
  const F4 w = 1 / inverse_w;
  const F4 u = at(s.u) * w, v = at(s.v) * w;
  const auto width = static_cast<float>(texture.levels[0].width);
  const auto height = static_cast<float>(texture.levels[0].height);
  const auto squared = [&](float by_u, float by_v, float by_w) {
    const F4 du = (by_u - u * by_w) * width, dv = (by_v - v * by_w) * height;
    return du * du + dv * dv;
  };
  const F4 fastest =
      _mm_max_ps(squared(s.u.b, s.v.b, s.inverse_w.b), squared(s.u.a, s.v.a, s.inverse_w.a));
  const F4 level = 0.5f * Log2(_mm_max_ps(_mm_set1_ps(1e-12f), fastest * w * w));
  return _mm_and_ps(level, _mm_cmpgt_ps(inverse_w, _mm_setzero_ps()));
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
  const auto gradient = [&](const std::vector<float>& values) {
    const double d1 = values[t.corner[1]] - values[t.corner[0]],
                 d2 = values[t.corner[2]] - values[t.corner[0]];
    return d1 * along_1 + d2 * along_2;
  };
  const geometry::Vector3 right = gradient(mesh.u), down = gradient(mesh.v);
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
