// Applies the effects of exposure, vignetting (darker corners) and sensor noise to rendered camera
// images.
//
// Parameters  (with their default values)
//   exposure (0 stops)      each stop doubles the light
//   gain (1)                factor that multiplies light and noise
//   vignetting (0)          fraction of the light that is missing in the corners. It grows with the
//                           square of the distance from the centre.
//   noise.*                 see sensing/noise.h. mean, stddev and biases apply to each pixel and
//                           channel, in units from 0 (black) to 1 (white).
// Model       the light of a pixel is the linear colour of the rendered image. Light that the
//             renderer has clipped at white is lost.
#pragma once

#include "gsv/model/image.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/parameters.h"

namespace gsv::rendering {

// Applies exposure, vignetting and noise to the images of one camera.
class Exposure {
 public:
  // Reports invalid parameters to the reader.
  explicit Exposure(sensing::ParameterReader& reader);

  // Whether Apply() would leave images unchanged.
  bool is_neutral() const;

  // Applies exposure, vignetting and noise to an RGB image. `sampling` determines the instant of
  // the noise.
  void Apply(const sensing::Sampling& sampling, const model::SensorDescription& description,
             model::Image& image) const;

 private:
  // Applies exposure, gain and vignetting.
  void ApplyLight(model::Image& image) const;
  void ApplyNoise(const sensing::Sampling& sampling, const model::SensorDescription& description,
                  model::Image& image) const;

  double light_ = 1;       // factor by which light is multiplied
  double gain_ = 1;        // factor for light and noise
  double vignetting_ = 0;  // fraction of the light that is missing in the corners
  sensing::NoiseModel noise_;
};

}  // namespace gsv::rendering
