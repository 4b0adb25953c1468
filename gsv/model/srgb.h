// Converts the sRGB encoding of files and images to linear light for shading (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <cmath>

namespace gsv::model {

// Decodes one component. `value` is clamped to [0, 1].
inline double LinearFromSrgb(double value) {
  value = std::clamp(value, 0.0, 1.0);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace gsv::model
