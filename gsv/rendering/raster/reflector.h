// The properties of surfaces that the lighting equations use. Each lane is for one pixel. Colours are
// linear.
#pragma once

#include "gsv/rendering/raster/simd.h"

namespace gsv::rendering::raster {

// The terms of the lighting equations that depend only on the roughness of a surface.
template <class F>
struct Gloss {
  Gloss() = default;
  explicit Gloss(F rough)
      : roughness(rough),
        alpha(rough * rough),
        half_alpha2(Splat<F>(0.5f) * (alpha * alpha)),
        alpha2_less_1(alpha * alpha - Splat<F>(1)),
        smoothness(Splat<F>(1) - rough),
        smoothness2(smoothness * smoothness),
        mirror(Fma(rough, Splat<F>(-0.0275f), Splat<F>(0.0425f))),
        scale(Fma(rough, Splat<F>(-0.572f), Splat<F>(1.04f))),
        bias(Fma(rough, Splat<F>(0.022f), Splat<F>(-0.04f))) {}

  F roughness, alpha;            // `alpha` is the roughness squared (alpha of GGX)
  F half_alpha2, alpha2_less_1;  // alpha² / 2 and alpha² - 1
  F smoothness, smoothness2;     // 1 - roughness, and the square of that
  // The parts of the reflection of the surroundings that do not depend on the direction of view.
  F mirror, scale, bias;
};

// The terms of the lighting equations that depend only on the normal of a surface.
template <class F>
struct Facing {
  Three<F> normal;  // unit length
  Three<F> around;  // ambient light on a matt surface
  F to_sun;         // cosine of the angle between the normal and the direction to the sun
};

// The colours in which a surface reflects and emits light.
template <class F>
struct Reflector {
  Reflector() = default;
  Reflector(const Three<F>& base, F metalness, const Three<F>& emitted, F ambient)
      : Reflector(base, metalness, emitted, ambient,
                  Bits(EqualInt((typename Lanes<F>::Ints)metalness, SplatInt<F>(0))) ==
                      (1 << Lanes<F>::kCount) - 1) {}
  // `has_no_metal` says that `metalness` is 0 in all lanes.
  Reflector(const Three<F>& base, F metalness, const Three<F>& emitted, F ambient,
            bool has_no_metal)
      : diffuse(base),
        specular(Splat<F>(0.04f, 0.04f, 0.04f)),
        emissive(emitted),
        occlusion(ambient),
        is_grey(has_no_metal) {
    if (has_no_metal) return;
    diffuse = base * (Splat<F>(1) - metalness);
    specular = Mixed(specular, base, metalness);
  }

  Three<F> diffuse, specular;  // `specular` is the reflectance at normal incidence
  Three<F> emissive;           // emitted light
  F occlusion;                 // the fraction of ambient light that reaches the surface
  bool is_grey = false;  // whether `specular` has the same value in all channels, in all lanes
};

}  // namespace gsv::rendering::raster
