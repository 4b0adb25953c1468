// From light to a sensor's numbers: exposure, the lens's darker corners, and noise.
//
// Parameters  exposure (0): stops, each of which doubles the light; gain (1): a factor on light and
//             on noise; vignetting (0): the part of the light that is missing in the corners, less
//             towards the middle with the square of the distance; noise.*: see sensing/noise.h, of
//             each pixel's channels, from 0 (black) to 1 (white); of these mean, stddev, bias.
// Model       light is the picture's colour, linear, so that what was clipped stays clipped.
#pragma once

#include "gsv/model/image.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/parameters.h"

namespace gsv::rendering {

class Exposure {
 public:
  // Refuses by the reader.
  explicit Exposure(sensing::ParameterReader& reader);

  // Whether it changes nothing.
  bool is_neutral() const;

  // An RGB picture as the sensor would give it at the sampling's instant.
  void Apply(const sensing::Sampling& sampling, const model::SensorDescription& description,
             model::Image& picture) const;

 private:
  void ApplyLight(model::Image& picture) const;
  void ApplyNoise(const sensing::Sampling& sampling, const model::SensorDescription& description,
                  model::Image& picture) const;

  double light_ = 1;  // a factor
  double gain_ = 1;
  double vignetting_ = 0;
  sensing::NoiseModel noise_;
};

}  // namespace gsv::rendering
