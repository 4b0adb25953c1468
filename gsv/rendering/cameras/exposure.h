// Exposure, vignetting and noise of camera images.
//
// Parameters  exposure (0): in stops, each doubles the light. gain (1): factor on light and noise.
//             vignetting (0): fraction of the light that is missing in the corners; it falls with
//             the square of the distance towards the centre. noise.*: see sensing/noise.h; for each
//             pixel and channel, from 0 (black) to 1 (white): mean, stddev and biases.
// Model       light is the linear colour of the image, so that clipped pixels stay clipped.
#pragma once

#include "gsv/model/image.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/parameters.h"

namespace gsv::rendering {

class Exposure {
 public:
  // Reports invalid parameters to the reader.
  explicit Exposure(sensing::ParameterReader& reader);

  // Whether Apply() would leave images unchanged.
  bool is_neutral() const;

  // Applies exposure, vignetting and noise to an RGB image. The noise is that of the instant of
  // `sampling`.
  void Apply(const sensing::Sampling& sampling, const model::SensorDescription& description,
             model::Image& image) const;

 private:
  void ApplyLight(model::Image& image) const;
  void ApplyNoise(const sensing::Sampling& sampling, const model::SensorDescription& description,
                  model::Image& image) const;

  double light_ = 1;  // factor by which light is multiplied
  double gain_ = 1;
  double vignetting_ = 0;
  sensing::NoiseModel noise_;
};

}  // namespace gsv::rendering
