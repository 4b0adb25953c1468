#include "gsv/rendering/raster/lighting.h"

#include <cmath>
#include <vector>

namespace gsv::rendering::raster {
namespace {

// The transfer function of IEC 61966-2-1.
double SrgbFromLinear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace

const std::uint8_t* EncodedValues() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> bytes(kEncodedValues + 4);
    for (int i = 0; i < kEncodedValues; ++i) {
      const double value = 255 * SrgbFromLinear(static_cast<double>(i) / (kEncodedValues - 1));
      bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(value));
    }
    return bytes;
  }();
  return table.data();
}

}  // namespace gsv::rendering::raster
