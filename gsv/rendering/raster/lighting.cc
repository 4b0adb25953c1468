#include "gsv/rendering/raster/lighting.h"

#include <algorithm>
#include <cmath>

namespace gsv::rendering::raster {
namespace {

F8x3 Splat3(const Float4& a) { return Splat(a[0], a[1], a[2]); }
F8 Mixed(F8 a, F8 b, F8 k) { return Fma(b - a, k, a); }
F8x3 Mixed(const F8x3& a, const F8x3& b, F8 k) {
  return {Mixed(a.x, b.x, k), Mixed(a.y, b.y, k), Mixed(a.z, b.z, k)};
}

// The properties of a surface that the lighting equations use.
struct Reflector {
  F8x3 normal, to_view;
  F8x3 diffuse, specular;  // `specular` is the reflectance at normal incidence
  F8 alpha, alpha2;        // the roughness squared (GGX's alpha), and the square of that
  F8 n_dot_v;
};

// Returns the light that a surface reflects towards the camera, for a source of strength 1 in the
// direction `to_light`.
F8x3 Reflected(const Reflector& s, const F8x3& to_light, F8 n_dot_l) {
  // The half vector h of light and view need not have unit length. For the sum l + v, |l + v|² is 2
  // + 2 l·v, and v·h is |l + v| / 2.
  const F8 l_dot_v = Dot(to_light, s.to_view);
  const F8 length2 = Max(Fma(l_dot_v, Splat(2), Splat(2)), Splat(1e-6f));
  const F8 n_dot_sum = Max(Dot(s.normal, to_light) + Dot(s.normal, s.to_view), Splat(0));
  const F8 m = Max(Fma(Sqrt(length2), Splat(-0.5f), Splat(1)), Splat(0)), m2 = m * m,
           m5 = m2 * m2 * m;
  // The GGX term n_dot_h² (alpha2 - 1) + 1, multiplied by |l + v|².
  const F8 d = Fma(n_dot_sum * n_dot_sum, s.alpha2 - Splat(1), length2);
  const F8 v =
      Max(Mixed(Splat(2) * n_dot_l * s.n_dot_v, n_dot_l + s.n_dot_v, s.alpha), Splat(1e-4f));
  const F8 gloss =
      Min(Splat(0.5f) * s.alpha2 * length2 * length2 / Max(d * d * v, Splat(1e-12f)), Splat(8));
  const auto channel = [&](F8 diffuse, F8 specular) {
    const F8 fresnel = Fma(Splat(1) - specular, m5, specular);
    return Fma(diffuse, Splat(1) - fresnel, fresnel * gloss) * n_dot_l;
  };
  return {channel(s.diffuse.x, s.specular.x), channel(s.diffuse.y, s.specular.y),
          channel(s.diffuse.z, s.specular.z)};
}

// Computes 2^x for x from -30 to 0 by a cubic between integer powers, within 1e-4.
F8 Exp2(F8 x) {
  x = Max(x, Splat(-30));
  const F8 whole = Floor(x), f = x - whole;
  const F8 power = Fma(f, Fma(f, Fma(f, Splat(0.0790198f), Splat(0.2241285f)), Splat(0.6968526f)),
                       Splat(0.9998119f));
  const I8 bits = (I8)_mm256_slli_epi32((__m256i)(Truncated(whole) + 127), 23);
  return power * (F8)bits;
}

F8x3 Ambient(const FrameBlock& block, const Reflector& s, F8 roughness) {
  const F8x3 below = Splat3(block.ambient_below), above = Splat3(block.ambient_above);
  F8x3 around = Mixed(below, above, Fma(s.normal.z, Splat(0.5f), Splat(0.5f)));
  // Surfaces that face the sun get more indirect light, so that shapes stay visible in shadow.
  around = around * Fma(Dot(s.normal, Splat3(block.to_sun)), Splat(0.2f), Splat(0.9f));
  const F8 n_dot_v = Dot(s.normal, s.to_view);
  const F8 mirrored_z = Fma(Splat(2) * n_dot_v, s.normal.z, -s.to_view.z);
  const F8 t = Clamp01(Fma(mirrored_z, Splat(2), Splat(0.5f)));
  const F8x3 horizon = Mixed(below, above, t * t * Fma(t, Splat(-2), Splat(3)));
  const F8x3 mirrored = Mixed(horizon, around, roughness);
  const F8 x = Splat(1) - roughness;
  const F8 a = Fma(Min(x * x, Exp2(Splat(-9.28f) * s.n_dot_v)), x,
                   Fma(roughness, Splat(-0.0275f), Splat(0.0425f)));
  const F8 scale = Fma(a, Splat(-1.04f), Fma(roughness, Splat(-0.572f), Splat(1.04f)));
  const F8 bias = Fma(a, Splat(1.04f), Fma(roughness, Splat(0.022f), Splat(-0.04f)));
  const auto channel = [&](F8 from_around, F8 diffuse, F8 from_mirror, F8 specular) {
    return Fma(from_around, diffuse, from_mirror * Fma(specular, scale, bias));
  };
  return {channel(around.x, s.diffuse.x, mirrored.x, s.specular.x),
          channel(around.y, s.diffuse.y, mirrored.y, s.specular.y),
          channel(around.z, s.diffuse.z, mirrored.z, s.specular.z)};
}

F8x3 FromLamp(const LightBlock& lamp, const Reflector& s, const F8x3& position) {
  const F8x3 axis = Splat3(lamp.direction_outer);
  F8x3 to_light = axis * Splat(-1);
  F8 strength = Splat(1);
  if (lamp.position_range[3] > 0) {
    const F8x3 offset = Splat3(lamp.position_range) - position;
    const F8 distance2 = Max(Dot(offset, offset), Splat(1e-8f));
    const F8 x2 = distance2 * Splat(lamp.attenuation[3]);
    // Returns early if all eight points are beyond the lamp's range or face away from the lamp. The
    // computation below would give no light either.
    if (Bits((x2 < Splat(1)) & (Dot(s.normal, offset) > Splat(0))) == 0) return Splat(0, 0, 0);
    const F8 window = Clamp01(Fma(-x2, x2, Splat(1)));
    const F8 distance = Sqrt(distance2);
    to_light = offset * (Splat(1) / distance);
    const F8 falloff =
        Fma(distance, Fma(distance, Splat(lamp.attenuation[2]), Splat(lamp.attenuation[1])),
            Splat(lamp.attenuation[0]));
    strength = window * window / Max(falloff, Splat(0.05f));
    if (lamp.direction_outer[3] > -1) {
      const F8 cone = Splat(0) - Dot(to_light, axis);
      strength =
          strength * Clamp01((cone - Splat(lamp.direction_outer[3])) * Splat(lamp.colour_inner[3]));
    }
  }
  const F8 n_dot_l = Clamp01(Dot(s.normal, to_light));
  // Weaker light would not be visible with eight bits.
  const I8 lit = (n_dot_l * strength) > Splat(1e-3f);
  if (Bits(lit) == 0) return Splat(0, 0, 0);
  return Reflected(s, to_light, n_dot_l) * (Splat3(lamp.colour_inner) * strength);
}

// The transfer function of IEC 61966-2-1.
double SrgbFromLinear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

// The tone mapper Khronos PBR Neutral, as in shaders.cc.
F8x3 ToneMapped(const F8x3& colour) {
  constexpr float kStart = 0.8f, kDesaturation = 0.15f, kRest = 1 - kStart;
  const F8 peak = Max(colour.x, Max(colour.y, colour.z));
  const I8 bright = peak >= Splat(kStart);
  if (Bits(bright) == 0) return colour;
  const F8 new_peak = Splat(1) - Splat(kRest * kRest) / (peak + Splat(kRest - kStart));
  const F8x3 scaled = colour * (new_peak / peak);
  const F8 white = Splat(1) - Splat(1) / Fma(peak - new_peak, Splat(kDesaturation), Splat(1));
  return Select(bright, Mixed(scaled, {new_peak, new_peak, new_peak}, white), colour);
}

}  // namespace

Lamps LightModel::Reaching(const geometry::Vector3& min, const geometry::Vector3& max) const {
  Lamps lamps;
  for (int i = 0; i < block_.light_count[0]; ++i) {
    const LightBlock& lamp = block_.lights[i];
    const double range = lamp.position_range[3];
    const double x = lamp.position_range[0], y = lamp.position_range[1], z = lamp.position_range[2];
    const double dx = x - std::clamp(x, min.x, max.x), dy = y - std::clamp(y, min.y, max.y),
                 dz = z - std::clamp(z, min.z, max.z);
    if (range > 0 && dx * dx + dy * dy + dz * dz > range * range) continue;
    lamps.lights[lamps.count++] = &lamp;
  }
  return lamps;
}

F8x3 LightModel::Colour(const Surfaces& surface, const F8x3& ray, const Lamps& lamps,
                        I8 used) const {
  const F8x3 position = ray * surface.w;
  Reflector s;
  s.normal = Normalized(surface.normal);
  s.to_view = Normalized(ray * Splat(-1));
  s.diffuse = surface.base * (Splat(1) - surface.metalness);
  s.specular = Mixed(Splat(0.04f, 0.04f, 0.04f), surface.base, surface.metalness);
  s.alpha = surface.roughness * surface.roughness;
  s.alpha2 = s.alpha * s.alpha;
  s.n_dot_v = Min(Max(Dot(s.normal, s.to_view), Splat(1e-3f)), Splat(1));

  F8x3 light = surface.emissive + Ambient(block_, s, surface.roughness) * surface.occlusion;
  const F8x3 to_sun = Splat3(block_.to_sun);
  const F8 n_dot_l = Clamp01(Dot(s.normal, to_sun));
  if (Bits(used & (n_dot_l > Splat(0))) != 0) {
    F8 visible = Splat(1);
    if (shadow_ != nullptr && block_.to_sun[3] > 0) {
      // The shadow is looked up at a point p a little above the surface, so that the surface does
      // not cast a shadow on itself.
      const F8 beside = Splat(block_.to_sun[3]) * (Splat(1.5f) - n_dot_l);
      const F8x3 face_normal = surface.has_normal_map ? Normalized(surface.face_normal) : s.normal;
      const F8x3 p = Fma(face_normal, beside, position);
      const auto& m = block_.shadow_from_relative;
      const auto row = [&](int i) {
        return Fma(Splat(m[i]), p.x,
                   Fma(Splat(m[4 + i]), p.y, Fma(Splat(m[8 + i]), p.z, Splat(m[12 + i]))));
      };
      visible = shadow_->Visible({row(0), row(1), row(2)}, used & (n_dot_l > Splat(0)));
    }
    if (Bits(used & (n_dot_l * visible > Splat(0))) != 0) {
      light = light + Reflected(s, to_sun, n_dot_l) * (Splat3(block_.sun_colour) * visible);
    }
  }
  for (int i = 0; i < lamps.count; ++i) light = light + FromLamp(*lamps.lights[i], s, position);
  return ToneMapped(light);
}

F8x3 LightModel::Sky(const F8x3& ray) const {
  const F8 height = ray.z / Sqrt(Dot(ray, ray));
  const F8 up = Clamp01(height), down = Clamp01(Splat(-8) * height);
  const F8 high = Splat(1) - (Splat(1) - up) * (Splat(1) - up);
  return Mixed(Mixed(Splat3(block_.horizon), Splat3(block_.zenith), high), Splat3(block_.nadir),
               down);
}

I8 Encoded(const F8x3& colour, I8 alpha) {
  // The number of entries of the table of encoded values. With so many entries, the values of
  // neighbouring entries differ by at most half an 8-bit step before rounding.
  constexpr int kSteps = 8192;
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> bytes(kSteps + 4);
    for (int i = 0; i < kSteps; ++i) {
      const double value = 255 * SrgbFromLinear(static_cast<double>(i) / (kSteps - 1));
      bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(value));
    }
    return bytes;
  }();
  const auto channel = [&](F8 value) {
    // NaN becomes black.
    const F8 at = Min(Max(value, Splat(0)), Splat(1));
    return GatherByte(table.data(), Truncated(Fma(at, Splat(kSteps - 1), Splat(0.5f))));
  };
  return channel(colour.x) | channel(colour.y) << 8 | channel(colour.z) << 16 | alpha << 24;
}

}  // namespace gsv::rendering::raster
