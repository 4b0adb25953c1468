#include "gsv/sensing/rays/echo.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "gsv/model/image.h"
#include "gsv/model/srgb.h"

namespace gsv::sensing {
namespace {

constexpr double kUnknown = 0.5;

double Luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

// Converts a byte of an sRGB image to linear light in [0, 1].
double LinearOf(std::uint8_t channel) {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = model::LinearFromSrgb(static_cast<double>(i) / 255);
    }
    return made;
  }();
  return table[channel];
}

// Returns the mean luminance of a grid of pixels.
double LuminanceOf(const model::Image& image) {
  constexpr int kGrid = 16;
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t width = static_cast<std::size_t>(std::max(image.width, 0));
  const std::size_t height = static_cast<std::size_t>(std::max(image.height, 0));
  if (channels < 3 || width * height == 0 || image.pixels.size() < width * height * channels) {
    return 1;
  }
  double sum = 0;
  for (std::size_t y = 0; y < kGrid; ++y) {
    for (std::size_t x = 0; x < kGrid; ++x) {
      const std::size_t pixel = y * height / kGrid * width + x * width / kGrid;
      const std::uint8_t* const rgb = &image.pixels[pixel * channels];
      sum += Luminance(LinearOf(rgb[0]), LinearOf(rgb[1]), LinearOf(rgb[2]));
    }
  }
  return sum / (kGrid * kGrid);
}

const model::Visual& VisualOf(const model::Link& link, std::size_t collision) {
  const std::string& name = link.collisions[collision].name;
  const auto same = std::find_if(link.visuals.begin(), link.visuals.end(),
                                 [&](const model::Visual& v) { return v.name == name; });
  if (same != link.visuals.end()) return *same;
  return link.visuals[collision < link.visuals.size() ? collision : 0];
}

}  // namespace

double ReflectanceOf(const model::Link& link, std::size_t collision) {
  if (link.visuals.empty()) return kUnknown;
  const model::Visual& visual = VisualOf(link, collision);
  if (visual.materials.empty()) return kUnknown;
  const model::Material& material = visual.materials.front();
  const model::Colour& c = material.base_colour;
  double reflectance =
      Luminance(model::LinearFromSrgb(c.r), model::LinearFromSrgb(c.g), model::LinearFromSrgb(c.b));
  if (material.base_colour_map != nullptr) reflectance *= LuminanceOf(*material.base_colour_map);
  return std::clamp(reflectance, 0.0, 1.0);
}

}  // namespace gsv::sensing
