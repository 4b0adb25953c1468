#include "gsv/rendering/cameras/exposure.h"

#include <algorithm>
#include <cmath>

#include "gsv/rendering/lenses/light_encoding.h"

namespace gsv::rendering {

Exposure::Exposure(sensing::ParameterReader& reader)
    : light_(std::exp2(reader.Number("exposure", 0, -20, 20))),
      gain_(reader.Number("gain", 1, 0, 1e6)),
      vignetting_(reader.Number("vignetting", 0, 0, 1)),
      noise_(ReadNoise(reader, "noise", 1)) {}

bool Exposure::is_neutral() const {
  return light_ == 1 && gain_ == 1 && vignetting_ == 0 && noise_.is_none();
}

void Exposure::Apply(const sensing::Sampling& sampling, const model::SensorDescription& description,
                     model::Image& image) const {
  ApplyLight(image);
  if (!noise_.is_none()) ApplyNoise(sampling, description, image);
}

void Exposure::ApplyLight(model::Image& image) const {
  if (light_ == 1 && gain_ == 1 && vignetting_ == 0) return;
  const double middle_x = 0.5 * image.width, middle_y = 0.5 * image.height;
  const double corner = middle_x * middle_x + middle_y * middle_y;
  std::uint8_t* at = image.pixels.data();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double dx = x + 0.5 - middle_x, dy = y + 0.5 - middle_y;
      const double left = 1 - vignetting_ * (dx * dx + dy * dy) / corner;
      const auto factor = static_cast<float>(light_ * gain_ * left);
      for (int c = 0; c < 3; ++c, ++at) *at = NumberFor(factor * LightOf(*at));
    }
  }
}

void Exposure::ApplyNoise(const sensing::Sampling& sampling,
                          const model::SensorDescription& description, model::Image& image) const {
  const sensing::NoisyReading noisy(sampling, description);
  const double mean = noise_.mean + noisy.Bias(noise_, 0);
  base::Noise white = sampling.NoiseOf(description);
  for (std::uint8_t& value : image.pixels) {
    const double off = mean + (noise_.stddev > 0 ? noise_.stddev * white.Gaussian() : 0);
    value = static_cast<std::uint8_t>(std::clamp(value + 255 * gain_ * off + 0.5, 0.0, 255.0));
  }
}

}  // namespace gsv::rendering
