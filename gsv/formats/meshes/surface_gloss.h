// Converts specular highlights to roughness.
#pragma once

#include <algorithm>
#include <cmath>

#include "gsv/model/material.h"

namespace gsv::formats {

// Returns the roughness r of a microfacet model for Blinn-Phong's exponent n: r^4 = 2 / (n + 2)
// (Walter et al. 2007). Without an exponent, the roughness is between 0.9 (no highlight) and 0.4
// (white highlight).
inline double RoughnessOf(const model::Colour& specular, double shininess) {
  const double strength = std::clamp(std::max({specular.r, specular.g, specular.b}), 0.0, 1.0);
  const double by_strength = 0.9 - 0.5 * strength;
  if (!(shininess > 1) || !std::isfinite(shininess) || strength == 0) return by_strength;
  return std::clamp(std::pow(2.0 / (shininess + 2.0), 0.25), 0.2, 0.95);
}

}  // namespace gsv::formats
