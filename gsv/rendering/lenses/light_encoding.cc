#include "gsv/rendering/lenses/light_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gsv::rendering {
namespace {

using Table = std::array<float, 256>;

double Linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Returns a table whose element i is the linear light of the encoded value i + `off` (0 to 255).
Table TableOf(double off) {
  Table table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(Linear((static_cast<double>(i) + off) / 255));
  }
  return table;
}

}  // namespace

float LightOf(std::uint8_t number) {
  static const Table kLight = TableOf(0);
  return kLight[number];
}

std::uint8_t NumberFor(float light) {
  // kMiddles[i] is the light at the boundary between the encoded values i and i + 1.
  static const Table kMiddles = TableOf(0.5);
  const auto above = std::upper_bound(kMiddles.begin(), kMiddles.end() - 1, light);
  return static_cast<std::uint8_t>(above - kMiddles.begin());
}

}  // namespace gsv::rendering
