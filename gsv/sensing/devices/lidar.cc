#include "gsv/sensing/devices/lidar.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

using geometry::kInfinity;
using geometry::kPi;
constexpr int kMostBeams = 1'000'000;

// Beams at evenly spaced angles, both ends included.
struct Angles {
  int count = 1;
  double first = 0, last = 0;

  double increment() const { return count > 1 ? (last - first) / (count - 1) : 0; }
  double angle(int i) const { return first + i * increment(); }
};

struct LidarSettings {
  Angles horizontal, vertical;
  double min = 0, max = 0;
  double noise_mean = 0, noise_stddev = 0;  // of white noise alone, drawn beam after beam
  std::optional<NoiseModel> full_noise;     // any other
};

Angles ReadAngles(ParameterReader& reader, const std::string& name, int samples, double min_angle,
                  double max_angle, double furthest) {
  Angles fan;
  fan.count = reader.Count(name + ".samples", samples, 1, kMostBeams);
  const double resolution = reader.Number(name + ".resolution", 1, 1e-6, 1e3);
  const double beams = std::max(1.0, std::floor(fan.count * resolution + 0.5));
  if (beams > kMostBeams) {
    reader.Refuse(fmt::format("{} asks for {} beams; the most are {}", name, beams, kMostBeams));
  }
  fan.count = static_cast<int>(std::min(beams, double{kMostBeams}));
  fan.first = reader.Number(name + ".min_angle", min_angle, -furthest, furthest);
  fan.last = reader.Number(name + ".max_angle", max_angle, -furthest, furthest);
  if (fan.first > fan.last) {
    reader.Refuse(fmt::format("{0}.min_angle is {1} and above {0}.max_angle, {2}", name, fan.first,
                              fan.last));
  }
  return fan;
}

LidarSettings ReadLidarSettings(ParameterReader& reader) {
  LidarSettings settings;
  settings.horizontal =
      ReadAngles(reader, "scan.horizontal", 360, -kPi, kPi - 2 * kPi / 360, 4 * kPi);
  settings.vertical = ReadAngles(reader, "scan.vertical", 1, 0, 0, kPi / 2 + 1e-6);
  if (double{1} * settings.horizontal.count * settings.vertical.count > kMostBeams) {
    reader.Refuse(fmt::format("the scan has {} by {} beams; the most are {}",
                              settings.horizontal.count, settings.vertical.count, kMostBeams));
  }
  settings.min = reader.Number("range.min", 0.08, 0, 1e4);
  settings.max = reader.Number("range.max", 10, 1e-3, 1e4);
  if (settings.min > settings.max) {
    reader.Refuse(
        fmt::format("range.min is {} and above range.max, {}", settings.min, settings.max));
  }
  const NoiseModel noise = ReadNoise(reader, "noise", 1e3);
  NoiseModel white;
  white.mean = noise.mean, white.stddev = noise.stddev;
  if (noise == white) {
    settings.noise_mean = noise.mean, settings.noise_stddev = noise.stddev;
  } else {
    settings.full_noise = noise;
  }
  return settings;
}

// Directions in the sensor's frame, in the order of the values.
std::vector<Vector3> Directions(const LidarSettings& settings) {
  std::vector<Vector3> directions;
  directions.reserve(std::size_t(settings.horizontal.count) * settings.vertical.count);
  for (int row = 0; row < settings.vertical.count; ++row) {
    const double e = settings.vertical.angle(row);
    for (int i = 0; i < settings.horizontal.count; ++i) {
      const double a = settings.horizontal.angle(i);
      directions.push_back({std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)});
    }
  }
  return directions;
}

// The fan nearest to the horizontal.
int LevelRow(const Angles& vertical) {
  int best = 0;
  for (int row = 1; row < vertical.count; ++row) {
    if (std::abs(vertical.angle(row)) < std::abs(vertical.angle(best))) best = row;
  }
  return best;
}

class Lidar final : public SensorOf<readings::Lidar, messages::sensor_msgs::LaserScan> {
 public:
  Lidar(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), settings_(ReadLidarSettings(reader)) {
    if (reader.status()) directions_ = Directions(settings_);
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose world_from_lidar = sampling.WorldFromSensor(description());
    Reading reading = sampling.Stamped();
    reading.values.reserve(directions_.size());
    base::Noise noise = sampling.NoiseOf(description());
    std::optional<NoisyReading> noisy;
    if (settings_.full_noise) noisy.emplace(sampling, description());
    const auto beams = static_cast<std::size_t>(settings_.horizontal.count);
    std::vector<double> ranges(beams);
    for (int row = 0; row < settings_.vertical.count; ++row) {
      sampling.Rays().Scan(FanOf(row, world_from_lidar), sampling.body(), ranges);
      for (double distance : ranges) {
        if (noisy) distance = Disturbed(*noisy, reading.values.size(), distance);
        reading.values.push_back(Measured(distance, noise));
      }
    }
    return reading;
  }

  bool CastsRays() const override { return true; }

 private:
  Fan FanOf(int row, const geometry::Pose& world_from_lidar) const {
    const auto beams = static_cast<std::size_t>(settings_.horizontal.count);
    const std::span all(directions_);
    return {world_from_lidar,
            settings_.horizontal.first,
            settings_.horizontal.increment(),
            settings_.vertical.angle(row),
            settings_.max,
            all.subspan(static_cast<std::size_t>(row) * beams, beams)};
  }

  // A dropout is an echo that is missed.
  double Disturbed(const NoisyReading& noisy, std::size_t beam, double distance) const {
    if (distance == kInfinity) return distance;
    const double read = noisy.Read(*settings_.full_noise, beam, distance);
    return std::isnan(read) ? kInfinity : read;
  }

  double Measured(double distance, base::Noise& noise) const {
    // Every beam draws, so that one beam's noise does not hang on what another hits.
    const double error = settings_.noise_stddev > 0
                             ? settings_.noise_mean + settings_.noise_stddev * noise.Gaussian()
                             : settings_.noise_mean;
    if (distance == kInfinity) return kInfinity;
    if (distance < settings_.min) return -kInfinity;
    return std::clamp(distance + error, settings_.min, settings_.max);
  }

  Message ToMessage(const Values& scan, const Reading&, const std::string&) const override {
    const Angles& fan = settings_.horizontal;
    const double rate = description().update_rate;
    Message message;
    message.angle_min = static_cast<float>(fan.first);
    message.angle_max = static_cast<float>(fan.angle(fan.count - 1));
    message.angle_increment = static_cast<float>(fan.increment());
    message.scan_time = rate > 0 ? static_cast<float>(1 / rate) : 0;
    message.range_min = static_cast<float>(settings_.min);
    message.range_max = static_cast<float>(settings_.max);
    const auto beams = static_cast<std::size_t>(fan.count);
    const std::size_t first = static_cast<std::size_t>(LevelRow(settings_.vertical)) * beams;
    for (std::size_t i = first; i < std::min(first + beams, scan.ranges.size()); ++i) {
      message.ranges.push_back(static_cast<float>(scan.ranges[i]));
    }
    return message;
  }

  std::vector<Segment> BeamsOf(const Values& scan) const override {
    std::vector<Segment> beams;
    for (std::size_t i = 0; i < std::min(directions_.size(), scan.ranges.size()); ++i) {
      if (std::isfinite(scan.ranges[i])) beams.push_back({{}, scan.ranges[i] * directions_[i]});
    }
    return beams;
  }

  const LidarSettings settings_;
  std::vector<Vector3> directions_;
};

}  // namespace

SensorType LidarType() {
  return MakeSensorType<Lidar>(readings::Lidar::kType, {"ray", "gpu_ray", "gpu_lidar"},
                               Overlay::kPoints);
}

}  // namespace gsv::sensing
