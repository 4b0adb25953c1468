#include "gsv/rendering/raster/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gsv/rendering/raster/raster_texture.h"

namespace gsv::rendering::raster {
namespace {

// Decodes sRGB with a cubic, as in shaders.cc.
F8 Decoded(F8 c) {
  return c * Fma(c, Fma(c, Splat(0.305306011f), Splat(0.682171111f)), Splat(0.012522878f));
}

// The weights of the triangle's second and third corner, and w.
struct Weights {
  F8 first, second, w;
};

Weights WeightsAt(const Triangle& t, F8 dx, float dy) {
  const auto q = [&](int i) { return Fma(Splat(t.a[i]), dx, Splat(t.c[i] + t.b[i] * dy)); };
  const F8 q0 = q(0), q1 = q(1), q2 = q(2);
  const F8 w = Splat(1) / (q0 + q1 + q2);
  return {q1 * w, q2 * w, w};
}

F8 Between(const std::vector<float>& values, const Triangle& t, const Weights& k) {
  const float v0 = values[t.corner[0]];
  return Fma(Splat(values[t.corner[1]] - v0), k.first,
             Fma(Splat(values[t.corner[2]] - v0), k.second, Splat(v0)));
}

// Approximates the binary logarithm from the number's exponent and fraction.
float Log2(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return static_cast<float>(bits) * (1.0f / (1 << 23)) - 127;
}

F8 At(const TriangleSurface::Plane& plane, F8 dx, float dy) {
  return Fma(Splat(plane.a), dx, Splat(plane.c + plane.b * dy));
}

// Returns the mip level at which a texel is about as large as a pixel. dx and dy: change of the
// texture coordinates across a pixel.
float LevelAt(const TriangleSurface& s, float dx, float dy, const RasterTexture& texture) {
  const auto at = [&](const TriangleSurface::Plane& p) { return p.c + p.a * dx + p.b * dy; };
  const float inverse_w = at(s.inverse_w);
  if (!(inverse_w > 0)) return 0;
  const float w = 1 / inverse_w;
  const float u = at(s.u) * w, v = at(s.v) * w;
  const auto width = static_cast<float>(texture.levels[0].width);
  const auto height = static_cast<float>(texture.levels[0].height);
  const auto squared = [&](float by_u, float by_v, float by_w) {
    const float du = (by_u - u * by_w) * width, dv = (by_v - v * by_w) * height;
    return du * du + dv * dv;
  };
  const float fastest =
      std::max(squared(s.u.a, s.v.a, s.inverse_w.a), squared(s.u.b, s.v.b, s.inverse_w.b));
  return 0.5f * Log2(std::max(fastest * w * w, 1e-12f));
}

// Applies the normal map in a frame along the texture's axes, which follows from the triangle's
// edges (Schüler, "Followup: normal mapping without precomputed tangents", 2013). v runs downwards.
F8x3 Bumped(const Drawn& drawn, const Triangle& t, const Texels& bump, const F8x3& n) {
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
  if (!(longest > 0)) return n;
  const double k = 1 / std::sqrt(longest);
  const auto splat = [&](const geometry::Vector3& a) {
    return Splat(static_cast<float>(k * a.x), static_cast<float>(k * a.y),
                 static_cast<float>(k * a.z));
  };
  const auto centred = [](F8 value) { return Fma(value, Splat(2), Splat(-1)); };
  return Normalized(splat(right) * centred(bump.r) - splat(down) * centred(bump.g) +
                    n * centred(bump.b));
}

}  // namespace

I8 Solid(const Triangle& triangle, const RasterMesh& mesh, const RasterTexture& holes, float level,
         F8 dx, float dy) {
  const Weights k = WeightsAt(triangle, dx, dy);
  return Sample(holes, level, Between(mesh.u, triangle, k), Between(mesh.v, triangle, k)).a >=
         Splat(0.5f);
}

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

void FillIn(const Drawn& drawn, const Triangle& t, const TriangleSurface& surface, int x, int y,
            I8 mask, bool is_first, const F8x3& ray, Surfaces& s) {
  const DrawGroup& group = *drawn.group;
  const F8 dx = Splat(static_cast<float>(x) - t.x0) + Steps();
  const float dy = static_cast<float>(y) - t.y0;
  const F8 w = Splat(1) / At(surface.inverse_w, dx, dy);
  F8x3 n;
  if (surface.is_flat) {
    n = Splat(surface.normal[0].c, surface.normal[1].c, surface.normal[2].c);
  } else {
    n = {At(surface.normal[0], dx, dy), At(surface.normal[1], dx, dy),
         At(surface.normal[2], dx, dy)};
  }
  if (group.double_sided) {
    // Use the normal of the side that the camera sees.
    n = Select(Dot(n, ray) > Splat(0), n * Splat(-1), n);
  }
  const bool has_textures = group.base_colour || group.normal || group.metallic_roughness ||
                            group.emissive || group.occlusion || group.light;
  if (is_first) {
    s.w = w, s.normal = n, s.number = SplatInt(surface.number);
    s.has_normal_map = false;
  } else {
    s.w = Select(mask, w, s.w);
    s.normal = Select(mask, n, s.normal);
    if (s.has_normal_map) s.face_normal = Select(mask, n, s.face_normal);
    s.number = SelectInt(mask, SplatInt(surface.number), s.number);
  }
  if (!is_first && s.plain == &drawn) return;
  s.plain = is_first && !has_textures ? &drawn : nullptr;

  const SurfaceFactors& f = *drawn.factors;
  F8x3 base = Splat(f.base_colour[0], f.base_colour[1], f.base_colour[2]);
  F8x3 emissive = Splat(f.emissive_metalness[0], f.emissive_metalness[1], f.emissive_metalness[2]);
  F8 alpha = Splat(f.base_colour[3]), metalness = Splat(f.emissive_metalness[3]),
     roughness = Splat(f.roughness), occlusion = Splat(1);
  if (has_textures) {
    const F8 u = At(surface.u, dx, dy) * w, v = At(surface.v, dx, dy) * w;
    const int seen = Bits(mask);
    const float middle = 0.5f * static_cast<float>(__builtin_ctz(static_cast<unsigned>(seen)) + 31 -
                                                   __builtin_clz(static_cast<unsigned>(seen)));
    const auto sample = [&](const std::shared_ptr<const DrawTexture>& of) {
      const auto& texture = static_cast<const RasterTexture&>(*of);
      return Sample(texture, LevelAt(surface, static_cast<float>(x) - t.x0 + middle, dy, texture),
                    u, v);
    };
    if (group.base_colour) {
      const Texels texel = sample(group.base_colour);
      base = base * F8x3{Decoded(texel.r), Decoded(texel.g), Decoded(texel.b)};
      alpha = alpha * texel.a;
    }
    if (group.metallic_roughness) {
      const Texels texel = sample(group.metallic_roughness);
      metalness = metalness * texel.b;
      roughness = Max(roughness * texel.g, Splat(0.05f));
    }
    if (group.emissive) {
      const Texels texel = sample(group.emissive);
      emissive = emissive * F8x3{Decoded(texel.r), Decoded(texel.g), Decoded(texel.b)};
    }
    if (group.occlusion) occlusion = sample(group.occlusion).r;
    if (group.light) {
      const Texels texel = sample(group.light);
      const F8x3 diffuse = base * (Splat(1) - metalness);
      emissive = emissive +
                 F8x3{Decoded(texel.r), Decoded(texel.g), Decoded(texel.b)} * (diffuse * occlusion);
    }
    if (group.normal) {
      if (!s.has_normal_map) s.face_normal = s.normal;
      s.has_normal_map = true;
      const F8x3 bumped = Bumped(drawn, t, sample(group.normal), Normalized(n));
      s.normal = is_first ? bumped : Select(mask, bumped, s.normal);
    }
  }
  if (is_first) {
    s.base = base, s.emissive = emissive, s.alpha = alpha, s.metalness = metalness;
    s.roughness = roughness, s.occlusion = occlusion;
    return;
  }
  s.base = Select(mask, base, s.base);
  s.emissive = Select(mask, emissive, s.emissive);
  s.alpha = Select(mask, alpha, s.alpha);
  s.metalness = Select(mask, metalness, s.metalness);
  s.roughness = Select(mask, roughness, s.roughness);
  s.occlusion = Select(mask, occlusion, s.occlusion);
}

}  // namespace gsv::rendering::raster
