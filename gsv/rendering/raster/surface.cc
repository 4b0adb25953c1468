#include "gsv/rendering/raster/surface.h"

#include <cmath>

#include "gsv/rendering/raster/raster_texture.h"

namespace gsv::rendering::raster {
namespace {

// From sRGB by a cubic, as in shaders.cc.
F8 Decoded(F8 c) {
  return c * Fma(c, Fma(c, Splat(0.305306011f), Splat(0.682171111f)), Splat(0.012522878f));
}

// Weights of the second and third corner, and w.
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

// About the base two logarithm, from a number's exponent and fraction.
float Log2(float value) {
  int exponent = 0;
  const float fraction = std::frexp(value, &exponent);  // [0.5, 1)
  return static_cast<float>(exponent) + (2 * fraction - 2);
}

// Of a square texture of one texel: how many times its coordinates change across a pixel, as a
// level, in the middle of the eight pixels.
float LevelOfOne(const Triangle& t, const RasterMesh& mesh, float dx, float dy, float width,
                 float height) {
  float q = 0, a = 0, b = 0, u = 0, v = 0, u_x = 0, u_y = 0, v_x = 0, v_y = 0;
  for (int i = 0; i < 3; ++i) {
    const float at = t.c[i] + t.a[i] * dx + t.b[i] * dy;
    const float corner_u = mesh.u[t.corner[i]] * width, corner_v = mesh.v[t.corner[i]] * height;
    q += at, a += t.a[i], b += t.b[i];
    u += at * corner_u, v += at * corner_v;
    u_x += t.a[i] * corner_u, v_x += t.a[i] * corner_v;
    u_y += t.b[i] * corner_u, v_y += t.b[i] * corner_v;
  }
  if (!(q > 0)) return 0;
  const float w = 1 / q;
  u *= w, v *= w;
  const float across = (u_x - u * a) * (u_x - u * a) + (v_x - v * a) * (v_x - v * a);
  const float down = (u_y - u * b) * (u_y - u * b) + (v_y - v * b) * (v_y - v * b);
  return 0.5f * Log2(std::max(std::max(across, down) * w * w, 1e-12f));
}

// A frame along the texture's axes (Schüler, "Followup: normal mapping without precomputed
// tangents", 2013), from the triangle's edges. v runs downwards.
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

void FillIn(const Drawn& drawn, const Triangle& t, int x, int y, I8 mask, const F8x3& ray,
            Surfaces& s) {
  const RasterMesh& mesh = *drawn.mesh;
  const DrawGroup& group = *drawn.group;
  const F8 dx = Splat(static_cast<float>(x) - t.x0) + Steps();
  const float dy = static_cast<float>(y) - t.y0;
  const Weights k = WeightsAt(t, dx, dy);
  const F8 nx = Between(mesh.normal_x, t, k), ny = Between(mesh.normal_y, t, k),
           nz = Between(mesh.normal_z, t, k);
  const auto turned = [&](const float(&row)[3]) {
    return Fma(Splat(row[0]), nx, Fma(Splat(row[1]), ny, Splat(row[2]) * nz));
  };
  F8x3 n = Normalized({turned(drawn.normal[0]), turned(drawn.normal[1]), turned(drawn.normal[2])});
  if (group.double_sided) {
    // The side that the camera sees.
    n = Select(Dot(n, ray) > Splat(0), n * Splat(-1), n);
  }
  const SurfaceFactors& f = *drawn.factors;
  F8x3 base = Splat(f.base_colour[0], f.base_colour[1], f.base_colour[2]);
  F8x3 emissive = Splat(f.emissive_metalness[0], f.emissive_metalness[1], f.emissive_metalness[2]);
  F8 alpha = Splat(f.base_colour[3]), metalness = Splat(f.emissive_metalness[3]),
     roughness = Splat(f.roughness);
  F8x3 bumped = n;
  if (group.base_colour || group.normal || group.metallic_roughness || group.emissive) {
    const F8 u = Between(mesh.u, t, k), v = Between(mesh.v, t, k);
    const int seen = Bits(mask);
    const float middle = 0.5f * static_cast<float>(__builtin_ctz(static_cast<unsigned>(seen)) + 31 -
                                                   __builtin_clz(static_cast<unsigned>(seen)));
    const auto sample = [&](const std::shared_ptr<const DrawTexture>& of) {
      const auto& texture = static_cast<const RasterTexture&>(*of);
      const float level = LevelOfOne(t, mesh, static_cast<float>(x) - t.x0 + middle, dy,
                                     static_cast<float>(texture.levels[0].width),
                                     static_cast<float>(texture.levels[0].height));
      return Sample(texture, level, u, v);
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
    if (group.normal) bumped = Bumped(drawn, t, sample(group.normal), n);
  }
  // Neighbouring surfaces, and the same one of two things, get different numbers of eight bits.
  const int number = (97 * mesh.surface[t.corner[0]] + 57 * static_cast<int>(f.surface)) % 255 + 1;
  s.w = Select(mask, k.w, s.w);
  s.normal = Select(mask, bumped, s.normal);
  s.face_normal = Select(mask, n, s.face_normal);
  s.base = Select(mask, base, s.base);
  s.emissive = Select(mask, emissive, s.emissive);
  s.alpha = Select(mask, alpha, s.alpha);
  s.metalness = Select(mask, metalness, s.metalness);
  s.roughness = Select(mask, roughness, s.roughness);
  s.number = SelectInt(mask, SplatInt(number), s.number);
}

}  // namespace gsv::rendering::raster
