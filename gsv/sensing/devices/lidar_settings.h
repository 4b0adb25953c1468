// The parameters of a lidar (lidar.h), read and checked.
#pragma once

#include <optional>

#include "gsv/sensing/devices/lidar_errors.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/parameters.h"

namespace gsv::sensing {

// Evenly spaced angles of beams, from `first` to `last`, both included.
struct Angles {
  int count = 1;
  double first = 0, last = 0;  // rad

  // The angle between two beams, rad.
  double increment() const { return count > 1 ? (last - first) / (count - 1) : 0; }
  // The angle of beam i, rad.
  double angle(int i) const { return first + i * increment(); }
};

// The settings of a lidar. Angles are in rad and distances in m. `min` and `max` limit the measured
// range.
struct LidarSettings {
  Angles horizontal, vertical;
  double min = 0, max = 0;
  double noise_mean = 0, noise_stddev = 0;  // white noise of each beam, m
  // set if the parameters ask for more than white noise, such as a bias or a drift
  std::optional<NoiseModel> full_noise;
  LidarErrors errors;  // errors of real lidars, applied before the noise
  // `intensity_scale` is the intensity of a white surface at right angles to the beam, at the
  // distance `intensity_range` (m). If `intensity_range` is 0, the intensity does not depend on the
  // distance. If `intensity_scale` is 0, the lidar does not measure intensities.
  double intensity_scale = 0, intensity_range = 0;
};

// Reads the settings. Reports invalid parameters to the reader.
LidarSettings ReadLidarSettings(ParameterReader& reader);

}  // namespace gsv::sensing
