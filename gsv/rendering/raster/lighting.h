// The shading of the pixels of a vector, with the same terms as in shaders.cc.
#pragma once

#include <algorithm>

#include "gsv/rendering/raster/mixed_pixels.h"
#include "gsv/rendering/raster/sun_shadow.h"
#include "gsv/rendering/scene/frame_block.h"

namespace gsv::rendering::raster {

// A lamp of a frame block. All lanes of a member have the same value.
template <class F>
struct Lamp {
  Lamp() = default;
  explicit Lamp(const LightBlock& block)
      : position(
            Splat<F>(block.position_range[0], block.position_range[1], block.position_range[2])),
        axis(
            Splat<F>(block.direction_outer[0], block.direction_outer[1], block.direction_outer[2])),
        colour(Splat<F>(block.colour_inner[0], block.colour_inner[1], block.colour_inner[2])),
        constant(Splat<F>(block.attenuation[0])),
        linear(Splat<F>(block.attenuation[1])),
        quadratic(Splat<F>(block.attenuation[2])),
        inverse_range2(Splat<F>(block.attenuation[3])),
        outer(Splat<F>(block.direction_outer[3])),
        inverse_cone(Splat<F>(block.colour_inner[3])),
        is_directional(!(block.position_range[3] > 0)),
        has_cone(block.direction_outer[3] > -1) {}

  Three<F> position, axis, colour;
  F constant, linear, quadratic;  // attenuation
  F inverse_range2;               // 1 / range²
  F outer, inverse_cone;          // see LightBlock
  bool is_directional = false, has_cone = false;
};

// The lamps that can light a part of the image.
template <class F>
struct Lamps {
  int count = 0;
  const Lamp<F>* lamps[kMaxLights];
};

// Computes the colours of surfaces under the lights of an image.
template <class F>
class LightModel {
 public:
  using Mask = typename Lanes<F>::Mask;

  // `block` must include the shadow parameters. If `shadow` is null, there are no shadows.
  LightModel(const FrameBlock& block, const SunShadow* shadow)
      : block_(block),
        shadow_(block.to_sun[3] > 0 ? shadow : nullptr),
        to_sun_(SplatFirst(block.to_sun)),
        sun_colour_(SplatFirst(block.sun_colour)),
        below_(SplatFirst(block.ambient_below)),
        below_to_above_(SplatFirst(block.ambient_above) - below_),
        texel_(Splat<F>(block.to_sun[3])) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) {
        shadow_from_relative_[column][row] = Splat<F>(block.shadow_from_relative[4 * column + row]);
      }
    }
    for (int i = 0; i < block.light_count[0]; ++i) lamps_[i] = Lamp<F>(block.lights[i]);
  }

  // Returns the lamps that can light points in a box, given in the frame of FrustumOf().
  Lamps<F> Reaching(const geometry::Vector3& min, const geometry::Vector3& max) const {
    Lamps<F> lamps;
    for (int i = 0; i < block_.light_count[0]; ++i) {
      const Float4& at = block_.lights[i].position_range;
      const double range = at[3], x = at[0], y = at[1], z = at[2];
      const double dx = x - std::clamp(x, min.x, max.x), dy = y - std::clamp(y, min.y, max.y),
                   dz = z - std::clamp(z, min.z, max.z);
      if (range > 0 && dx * dx + dy * dy + dz * dz > range * range) continue;
      lamps.lamps[lamps.count++] = &lamps_[i];
    }
    return lamps;
  }

  // Returns the terms of a normal, which must have unit length.
  Facing<F> FacingOf(const Three<F>& normal) const {
    const F to_sun = Dot(normal, to_sun_);
    // Surfaces that face the sun get more indirect light, so that shapes stay visible in shadow.
    return {normal,
            Fma(below_to_above_, Fma(normal.z, Splat<F>(0.5f), Splat<F>(0.5f)), below_) *
                Fma(to_sun, Splat<F>(0.2f), Splat<F>(0.9f)),
            to_sun};
  }

  // Returns the tone-mapped linear colour in [0, 1]. Lanes outside `used` get any value.
  Three<F> Colour(const Surfaces<F>& surface, const Three<F>& ray, const Lamps<F>& lamps,
                  Mask used) const {
    const Facing<F> facing = FacingOf(Normalized(surface.normal));
    return Colour(
        Reflector<F>(surface.base, surface.metalness, surface.emissive, surface.occlusion),
        Gloss<F>(surface.roughness), facing,
        surface.has_normal_map ? Normalized(surface.face_normal) : facing.normal, surface.w, ray,
        lamps, used);
  }

  // As above, at the distances w along the view. `face_normal` does not include the normal map.
  Three<F> Colour(const Reflector<F>& reflector, const Gloss<F>& gloss, const Facing<F>& facing,
                  const Three<F>& face_normal, F w, const Three<F>& ray, const Lamps<F>& lamps,
                  Mask used) const {
    return reflector.is_grey
               ? ColourOf<true>(reflector, gloss, facing, face_normal, w, ray, lamps, used)
               : ColourOf<false>(reflector, gloss, facing, face_normal, w, ray, lamps, used);
  }

  // Returns the colour of the sky in these directions.
  Three<F> Sky(const Three<F>& ray) const {
    const F height = ray.z / Sqrt(Dot(ray, ray));
    const F up = Clamp01(height), down = Clamp01(Splat<F>(-8) * height);
    const F high = Splat<F>(1) - (Splat<F>(1) - up) * (Splat<F>(1) - up);
    return Mixed(Mixed(SplatFirst(block_.horizon), SplatFirst(block_.zenith), high),
                 SplatFirst(block_.nadir), down);
  }

 private:
  // Points of a surface, and the terms that depend on the direction to the camera.
  struct Point {
    const Reflector<F>& reflector;
    const Gloss<F>& gloss;
    const Facing<F>& facing;
    Three<F> position;
    Three<F> to_view;  // unit length
    F normal_to_view;  // cosine of the angle between the normal and `to_view`
    F n_dot_v;         // the same, but at least 1e-3
  };

  static Three<F> SplatFirst(const Float4& a) { return Splat<F>(a[0], a[1], a[2]); }

  // Computes 2^x for x from -30 to 0 by a cubic between integer powers, within 1e-4.
  static F Exp2(F x) {
    x = Max(x, Splat<F>(-30));
    const F whole = Floor(x), f = x - whole;
    const F power =
        Fma(f, Fma(f, Fma(f, Splat<F>(0.0790198f), Splat<F>(0.2241285f)), Splat<F>(0.6968526f)),
            Splat<F>(0.9998119f));
    return power * PowerOfTwo(Truncated(whole));
  }

  // The tone mapper Khronos PBR Neutral, as in shaders.cc.
  static Three<F> ToneMapped(const Three<F>& colour) {
    constexpr float kStart = 0.8f, kDesaturation = 0.15f, kRest = 1 - kStart;
    const F peak = Max(colour.x, Max(colour.y, colour.z));
    const Mask bright = AtLeast(peak, Splat<F>(kStart));
    if (!Any(bright)) return colour;
    const F new_peak = Splat<F>(1) - Splat<F>(kRest * kRest) / (peak + Splat<F>(kRest - kStart));
    const Three<F> scaled = colour * (new_peak / peak);
    const F white =
        Splat<F>(1) - Splat<F>(1) / Fma(peak - new_peak, Splat<F>(kDesaturation), Splat<F>(1));
    return Select(bright, Mixed(scaled, {new_peak, new_peak, new_peak}, white), colour);
  }

  // See Colour(). kGrey is Reflector::is_grey.
  template <bool kGrey>
  __attribute__((noinline)) Three<F> ColourOf(const Reflector<F>& reflector, const Gloss<F>& gloss,
                                              const Facing<F>& facing, const Three<F>& face_normal,
                                              F w, const Three<F>& ray, const Lamps<F>& lamps,
                                              Mask used) const {
    const Three<F> to_view = Normalized(ray * Splat<F>(-1));
    const F normal_to_view = Dot(facing.normal, to_view);
    const Point point{reflector,
                      gloss,
                      facing,
                      ray * w,
                      to_view,
                      normal_to_view,
                      Min(Max(normal_to_view, Splat<F>(1e-3f)), Splat<F>(1))};
    Three<F> light = reflector.emissive + Ambient<kGrey>(point) * reflector.occlusion;
    const F n_dot_l = Clamp01(facing.to_sun);
    const Mask sunny = used & Less(Splat<F>(0), n_dot_l);
    if (Any(sunny)) {
      const F visible =
          shadow_ == nullptr ? Splat<F>(1) : SunAt(face_normal, point.position, n_dot_l, sunny);
      if (Any(used & Less(Splat<F>(0), n_dot_l * visible))) {
        light = light +
                Reflected<kGrey>(point, to_sun_, facing.to_sun, n_dot_l) * (sun_colour_ * visible);
      }
    }
    for (int i = 0; i < lamps.count; ++i) AddLamp<kGrey>(*lamps.lamps[i], point, light);
    return ToneMapped(light);
  }

  // Returns the light of the surroundings that the points reflect towards the camera.
  template <bool kGrey>
  Three<F> Ambient(const Point& p) const {
    const Gloss<F>& gloss = p.gloss;
    const F mirrored_z = Fma(Splat<F>(2) * p.normal_to_view, p.facing.normal.z, -p.to_view.z);
    const F t = Clamp01(Fma(mirrored_z, Splat<F>(2), Splat<F>(0.5f)));
    const Three<F> horizon =
        Fma(below_to_above_, t * t * Fma(t, Splat<F>(-2), Splat<F>(3)), below_);
    const Three<F>& around = p.facing.around;
    const Three<F> mirrored = Mixed(horizon, around, gloss.roughness);
    const F a = Fma(Min(gloss.smoothness2, Exp2(Splat<F>(-9.28f) * p.n_dot_v)), gloss.smoothness,
                    gloss.mirror);
    const F scale = Fma(a, Splat<F>(-1.04f), gloss.scale);
    const F bias = Fma(a, Splat<F>(1.04f), gloss.bias);
    const Three<F>&diffuse = p.reflector.diffuse, &specular = p.reflector.specular;
    const F share_x = Fma(specular.x, scale, bias);
    const F share_y = kGrey ? share_x : Fma(specular.y, scale, bias);
    const F share_z = kGrey ? share_x : Fma(specular.z, scale, bias);
    return {Fma(around.x, diffuse.x, mirrored.x * share_x),
            Fma(around.y, diffuse.y, mirrored.y * share_y),
            Fma(around.z, diffuse.z, mirrored.z * share_z)};
  }

  // Returns the fraction of sunlight that reaches the points.
  F SunAt(const Three<F>& face_normal, const Three<F>& position, F n_dot_l, Mask needed) const {
    // The shadow is looked up at a point p a little above the surface, so that the surface does not
    // cast a shadow on itself.
    const Three<F> p = Fma(face_normal, texel_ * (Splat<F>(1.5f) - n_dot_l), position);
    const auto& m = shadow_from_relative_;
    const auto row = [&](int i) {
      return Fma(m[0][i], p.x, Fma(m[1][i], p.y, Fma(m[2][i], p.z, m[3][i])));
    };
    return shadow_->Visible(Three<F>{row(0), row(1), row(2)}, needed);
  }

  // Returns the light that the points reflect towards the camera, for a source of strength 1 in the
  // direction `to_light`. `normal_to_light` is the cosine of the angle between the normal and that
  // direction, and `n_dot_l` is the same limited to [0, 1].
  template <bool kGrey>
  static Three<F> Reflected(const Point& p, const Three<F>& to_light, F normal_to_light,
                            F n_dot_l) {
    // The half vector h of light and view need not have unit length. For the sum l + v, |l + v|² is
    // 2 + 2 l·v, and v·h is |l + v| / 2.
    const F l_dot_v = Dot(to_light, p.to_view);
    const F length2 = Max(Fma(l_dot_v, Splat<F>(2), Splat<F>(2)), Splat<F>(1e-6f));
    const F n_dot_sum = Max(normal_to_light + p.normal_to_view, Splat<F>(0));
    const F m = Max(Fma(Sqrt(length2), Splat<F>(-0.5f), Splat<F>(1)), Splat<F>(0)), m2 = m * m,
            m5 = m2 * m2 * m;
    // The GGX term n_dot_h² (alpha² - 1) + 1, multiplied by |l + v|².
    const F d = Fma(n_dot_sum * n_dot_sum, p.gloss.alpha2_less_1, length2);
    const F v = Max(Mixed(Splat<F>(2) * n_dot_l * p.n_dot_v, n_dot_l + p.n_dot_v, p.gloss.alpha),
                    Splat<F>(1e-4f));
    const F gloss = Min(p.gloss.half_alpha2 * length2 * length2 / Max(d * d * v, Splat<F>(1e-12f)),
                        Splat<F>(8));
    struct Shares {
      F diffuse, mirrored;
    };
    const auto shares = [&](F specular) -> Shares {
      const F fresnel = Fma(Splat<F>(1) - specular, m5, specular);
      return {Splat<F>(1) - fresnel, fresnel * gloss};
    };
    const Three<F>&diffuse = p.reflector.diffuse, &specular = p.reflector.specular;
    const Shares x = shares(specular.x), y = kGrey ? x : shares(specular.y),
                 z = kGrey ? x : shares(specular.z);
    return {Fma(diffuse.x, x.diffuse, x.mirrored) * n_dot_l,
            Fma(diffuse.y, y.diffuse, y.mirrored) * n_dot_l,
            Fma(diffuse.z, z.diffuse, z.mirrored) * n_dot_l};
  }

  // Adds the light of a lamp that the points reflect towards the camera.
  template <bool kGrey>
  static void AddLamp(const Lamp<F>& lamp, const Point& p, Three<F>& light) {
    Three<F> to_light = lamp.axis * Splat<F>(-1);
    F strength = Splat<F>(1);
    if (!lamp.is_directional) {
      const Three<F> offset = lamp.position - p.position;
      const F distance2 = Max(Dot(offset, offset), Splat<F>(1e-8f));
      const F x2 = distance2 * lamp.inverse_range2;
      // Returns early if all points are beyond the lamp's range or face away from the lamp. The
      // computation below would give no light either.
      if (!Any(Less(x2, Splat<F>(1)) & Less(Splat<F>(0), Dot(p.facing.normal, offset)))) {
        return;
      }
      const F window = Clamp01(Fma(-x2, x2, Splat<F>(1)));
      const F distance = Sqrt(distance2);
      to_light = offset * (Splat<F>(1) / distance);
      const F falloff = Fma(distance, Fma(distance, lamp.quadratic, lamp.linear), lamp.constant);
      strength = window * window / Max(falloff, Splat<F>(0.05f));
      if (lamp.has_cone) {
        const F cone = Splat<F>(0) - Dot(to_light, lamp.axis);
        strength = strength * Clamp01((cone - lamp.outer) * lamp.inverse_cone);
      }
    }
    const F normal_to_light = Dot(p.facing.normal, to_light);
    const F n_dot_l = Clamp01(normal_to_light);
    // Eight pixels to which the lamp gives too little light to be visible with eight bits get none.
    const Mask lit = AnyOfEight(Less(Splat<F>(1e-3f), n_dot_l * strength));
    if (!Any(lit)) return;
    const Three<F> sum =
        light + Reflected<kGrey>(p, to_light, normal_to_light, n_dot_l) * (lamp.colour * strength);
    light = Lanes<F>::kCount == 8 ? sum : Select(lit, sum, light);
  }

  const FrameBlock& block_;
  const SunShadow* shadow_;  // null without shadows
  // Values of the block. All lanes of a member have the same value.
  Three<F> to_sun_, sun_colour_, below_, below_to_above_;
  F texel_;                       // side of a texel of the shadow map, m
  F shadow_from_relative_[4][3];  // column by column
  Lamp<F> lamps_[kMaxLights];
};

// The number of entries of the table of encoded values. With so many entries, the values of
// neighbouring entries differ by at most half an 8-bit step before rounding.
inline constexpr int kEncodedValues = 8192;
// Returns the sRGB values (0 to 255) of linear light i / (kEncodedValues - 1). Three bytes after the
// table may be read, too.
const std::uint8_t* EncodedValues();

// Encodes linear colours in [0, 1] as sRGB, with `alpha` (0 to 255) in the highest byte.
template <class F>
typename Lanes<F>::Ints Encoded(const std::uint8_t* values, const Three<F>& colour,
                                typename Lanes<F>::Ints alpha) {
  const auto channel = [&](F value) {
    // NaN becomes black.
    const F at = Min(Max(value, Splat<F>(0)), Splat<F>(1));
    return GatherByte(values, Truncated(Fma(at, Splat<F>(kEncodedValues - 1), Splat<F>(0.5f))));
  };
  return channel(colour.x) | channel(colour.y) << 8 | channel(colour.z) << 16 | alpha << 24;
}

}  // namespace gsv::rendering::raster
