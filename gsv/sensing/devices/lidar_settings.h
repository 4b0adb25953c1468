// The parameters of a lidar (lidar.h), read and checked.
#pragma once

#include <optional>

#include "gsv/sensing/devices/lidar_errors.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/parameters.h"

namespace gsv::sensing {

// Beams at evenly spaced angles, including both ends.
struct Angles {
  int count = 1;
  double first = 0, last = 0;

  double increment() const { return count > 1 ? (last - first) / (count - 1) : 0; }
  double angle(int i) const { return first + i * increment(); }
};

// Angles in rad, ranges in m.
struct LidarSettings {
  Angles horizontal, vertical;
  double min = 0, max = 0;
  double noise_mean = 0, noise_stddev = 0;  // white noise, drawn for each beam
  std::optional<NoiseModel> full_noise;     // the noise model if it has other terms
  LidarErrors errors;                       // applied before the noise
  // The intensity of a white surface at right angles, at the range `intensity_range`, or at any
  // range if that is 0. A scale of 0 means that the lidar does not measure intensities.
  double intensity_scale = 0, intensity_range = 0;
};

// Reads the settings. Reports invalid parameters to the reader.
LidarSettings ReadLidarSettings(ParameterReader& reader);

}  // namespace gsv::sensing
