#include "gsv/sensing/devices/lidar.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gsv/geometry/constants.h"
#include "gsv/sensing/devices/lidar_messages.h"
#include "gsv/sensing/devices/lidar_settings.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/rays/echo.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

using geometry::kInfinity;
using messages::gsv_msgs::LidarScan;
using messages::sensor_msgs::LaserScan;
using messages::sensor_msgs::PointCloud2;

// Returns the direction of each beam in the sensor's frame, in the order of the reading's values.
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

// MessageType is LaserScan for one row, or LidarScan for several.
template <typename MessageType>
class Lidar final : public SensorOf<readings::Lidar, MessageType> {
 public:
  Lidar(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf<readings::Lidar, MessageType>(description), settings_(ReadLidarSettings(reader)) {
    if (reader.status()) directions_ = Directions(settings_);
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose world_from_lidar = sampling.WorldFromSensor(this->description());
    Reading reading = sampling.Stamped();
    reading.values.reserve(directions_.size() * (measures_intensity() ? 2 : 1));
    base::Noise noise = sampling.NoiseOf(this->description());
    std::optional<NoisyReading> noisy;
    if (settings_.full_noise) noisy.emplace(sampling, this->description());
    const auto beams = static_cast<std::size_t>(settings_.horizontal.count);
    std::vector<double> ranges(beams);
    for (int row = 0; row < settings_.vertical.count; ++row) {
      sampling.Rays().Scan(FanOf(row, world_from_lidar), sampling.body(), ranges);
      if (!settings_.errors.is_none()) {
        Disturb(settings_.errors, sampling, this->description(), settings_.horizontal.increment(),
                reading.values.size(), ranges);
      }
      for (double distance : ranges) {
        if (noisy) distance = Disturbed(*noisy, reading.values.size(), distance);
        reading.values.push_back(Measured(distance, noise));
      }
    }
    if (measures_intensity()) AddIntensities(sampling, world_from_lidar, reading);
    return reading;
  }

  bool CastsRays() const override { return true; }

  Sensor::Bytes EncodeCompanionOf(const Reading& reading,
                                  const std::string& frame_id) const override {
    const auto scan = ValuesOf<readings::Lidar>(reading, this->description().name);
    if (!scan) return {};
    const readings::Lidar divided = Divided(*scan);
    auto cloud =
        PointsOf(directions_, settings_.vertical.count, divided.ranges, divided.intensities);
    cloud.header = HeaderOf(reading, frame_id);
    return Encoded(cloud);
  }

 private:
  bool measures_intensity() const { return settings_.intensity_scale > 0; }

  readings::Lidar Divided(const readings::Lidar& scan) const {
    return measures_intensity() ? scan.WithIntensities() : scan;
  }

  void AddIntensities(const Sampling& sampling, const geometry::Pose& world_from_lidar,
                      Reading& reading) const {
    std::vector<Ray> rays;
    rays.reserve(directions_.size());
    for (const Vector3& direction : directions_) {
      rays.push_back(
          {world_from_lidar.position, world_from_lidar.orientation * direction, settings_.max});
    }
    std::vector<std::optional<Echo>> echoes(rays.size());
    FindEchoes(sampling.Rays(), rays, sampling.body(), echoes);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool is_lost = !echoes[i] || !std::isfinite(reading.values[i]);
      reading.values.push_back(is_lost ? 0 : IntensityOf(*echoes[i]));
    }
  }

  double IntensityOf(const Echo& echo) const {
    const double fall =
        settings_.intensity_range > 0 ? settings_.intensity_range / echo.distance : 1;
    return settings_.intensity_scale * echo.reflectance * echo.cosine * fall * fall;
  }

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

  // Returns the distance with noise, or infinity for a dropout (a beam without an echo).
  double Disturbed(const NoisyReading& noisy, std::size_t beam, double distance) const {
    if (distance == kInfinity) return distance;
    const double read = noisy.Read(*settings_.full_noise, beam, distance);
    return std::isnan(read) ? kInfinity : read;
  }

  double Measured(double distance, base::Noise& noise) const {
    // A random number is drawn for every beam, even if the beam hits nothing. So the noise of one
    // beam does not depend on the hits of other beams.
    const double error = settings_.noise_stddev > 0
                             ? settings_.noise_mean + settings_.noise_stddev * noise.Gaussian()
                             : settings_.noise_mean;
    if (distance == kInfinity) return kInfinity;
    if (distance < settings_.min) return -kInfinity;
    return std::clamp(distance + error, settings_.min, settings_.max);
  }

  typename SensorOf<readings::Lidar, MessageType>::Message ToMessage(
      const readings::Lidar& scan, const Reading&, const std::string&) const override {
    MessageType message;
    Write(settings_, Divided(scan), message);
    const double rate = this->description().update_rate;
    message.scan_time = rate > 0 ? static_cast<float>(1 / rate) : 0;
    return message;
  }

  std::vector<Segment> BeamsOf(const readings::Lidar& all) const override {
    const readings::Lidar scan = Divided(all);
    std::vector<Segment> beams;
    for (std::size_t i = 0; i < std::min(directions_.size(), scan.ranges.size()); ++i) {
      if (std::isfinite(scan.ranges[i])) beams.push_back({{}, scan.ranges[i] * directions_[i]});
    }
    return beams;
  }

  const LidarSettings settings_;
  std::vector<Vector3> directions_;
};

bool HasRows(const model::SensorDescription& description) {
  ParameterReader reader(description);
  return ReadLidarSettings(reader).vertical.count > 1;
}

}  // namespace

SensorType LidarType() {
  using OneRow = Lidar<LaserScan>;
  using Rows = Lidar<LidarScan>;
  auto type = MakeSensorType<OneRow>(readings::Lidar::kType, {"ray", "gpu_ray", "gpu_lidar"},
                                     Overlay::kPoints);
  const auto rows = MakeSensorType<Rows>(readings::Lidar::kType);
  const SensorMessages of_rows{
      rows.schema, Companion{"points", &messages::SchemaOf<PointCloud2>(), /*of_readings=*/true}};
  type.create = [one_row = type.create, of_rows = rows.create](const auto& description) {
    return HasRows(description) ? of_rows(description) : one_row(description);
  };
  type.messages_of = [schema = type.schema, of_rows](const auto& description) {
    return HasRows(description) ? of_rows : SensorMessages{schema, std::nullopt};
  };
  return type;
}

}  // namespace gsv::sensing
