#include "gsv/sensing/devices/lidar_settings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/readings/catalogue.h"

namespace gsv::sensing {
namespace {

using geometry::kPi;
constexpr int kMaxBeams = 1'000'000;

Angles ReadAngles(ParameterReader& reader, const std::string& name, int samples, double min_angle,
                  double max_angle, double furthest) {
  Angles fan;
  fan.count = reader.Count(name + ".samples", samples, 1, kMaxBeams);
  const double resolution = reader.Number(name + ".resolution", 1, 1e-6, 1e3);
  const double beams = std::max(1.0, std::floor(fan.count * resolution + 0.5));
  if (beams > kMaxBeams) {
    reader.Refuse(
        fmt::format("{} asks for {} beams; at most {} are allowed", name, beams, kMaxBeams));
  }
  fan.count = static_cast<int>(std::min(beams, double{kMaxBeams}));
  fan.first = reader.Number(name + ".min_angle", min_angle, -furthest, furthest);
  fan.last = reader.Number(name + ".max_angle", max_angle, -furthest, furthest);
  if (fan.first > fan.last) {
    reader.Refuse(fmt::format("{0}.min_angle ({1}) is larger than {0}.max_angle ({2})", name,
                              fan.first, fan.last));
  }
  return fan;
}

}  // namespace

LidarSettings ReadLidarSettings(ParameterReader& reader) {
  LidarSettings settings;
  settings.horizontal =
      ReadAngles(reader, "scan.horizontal", 360, -kPi, kPi - 2 * kPi / 360, 4 * kPi);
  settings.vertical = ReadAngles(reader, "scan.vertical", 1, 0, 0, kPi / 2 + 1e-6);
  if (double{1} * settings.horizontal.count * settings.vertical.count > kMaxBeams) {
    reader.Refuse(fmt::format("the scan has {} by {} beams; at most {} are allowed",
                              settings.horizontal.count, settings.vertical.count, kMaxBeams));
  }
  settings.min = reader.Number("range.min", 0.08, 0, 1e4);
  settings.max = reader.Number("range.max", 10, 1e-3, 1e4);
  if (settings.min > settings.max) {
    reader.Refuse(
        fmt::format("range.min ({}) is larger than range.max ({})", settings.min, settings.max));
  }
  const NoiseModel noise = ReadNoise(reader, "noise", 1e3);
  NoiseModel white;
  white.mean = noise.mean, white.stddev = noise.stddev;
  if (noise == white) {
    settings.noise_mean = noise.mean, settings.noise_stddev = noise.stddev;
  } else {
    settings.full_noise = noise;
  }
  settings.errors = ReadLidarErrors(reader);
  settings.intensity_scale = reader.Number(readings::Lidar::kIntensityParameter, 0, 0, 1e9);
  settings.intensity_range = reader.Number("intensity_range", 0, 0, 1e4);
  return settings;
}

}  // namespace gsv::sensing
