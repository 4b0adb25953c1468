#include "gsv/sensing/devices/positioning.h"

#include <numbers>

#include "gsv/messages/geometry_msgs.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/frames.h"
#include "gsv/sensing/parameters.h"

namespace gsv::sensing {
namespace {

struct PositioningSettings {
  double position_stddev = 0;
  double orientation_stddev = 0;
};

base::Result<PositioningSettings> ReadPositioningSettings(
    const model::SensorDescription& description) {
  ParameterReader reader(description);
  PositioningSettings settings;
  settings.position_stddev = reader.Number("noise.position.stddev", 0, 0, 1e3);
  settings.orientation_stddev = reader.Number("noise.orientation.stddev", 0, 0, std::numbers::pi);
  if (!reader.status()) return base::Fail(reader.status().error());
  return settings;
}

class Positioning final : public Sensor {
 public:
  Positioning(const model::SensorDescription& description, const PositioningSettings& settings)
      : Sensor(description), settings_(settings) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose pose = sampling.WorldFromSensor(description());
    const geometry::RollPitchYaw angles = geometry::ToRollPitchYaw(pose.orientation);
    Reading reading = sampling.Stamped();
    reading.values = {pose.position.x, pose.position.y, pose.position.z,
                      angles.roll,     angles.pitch,    angles.yaw};
    if (settings_.position_stddev == 0 && settings_.orientation_stddev == 0) return reading;
    base::Noise noise = sampling.NoiseOf(description());
    if (settings_.position_stddev > 0) {
      for (int i = 0; i < 3; ++i) reading.values[i] += settings_.position_stddev * noise.Gaussian();
    }
    if (settings_.orientation_stddev > 0) {
      reading.values[5] =
          geometry::WrapAngle(reading.values[5] + settings_.orientation_stddev * noise.Gaussian());
    }
    return reading;
  }

 private:
  PositioningSettings settings_;
};

std::vector<std::uint8_t> EncodePose(const model::SensorDescription&, const Reading& reading,
                                     const std::string&) {
  messages::geometry_msgs::PoseStamped message;
  message.header = HeaderOf(reading, std::string(kWorldFrame));
  if (reading.values.size() == 6) {
    const auto& v = reading.values;
    const geometry::Quaternion q = geometry::FromRollPitchYaw({v[3], v[4], v[5]});
    message.pose.position = {v[0], v[1], v[2]};
    message.pose.orientation = {q.x, q.y, q.z, q.w};
  }
  return Encoded(message);
}

}  // namespace

SensorType PositioningType() {
  SensorType type;
  type.name = "positioning";
  type.create =
      [](const model::SensorDescription& description) -> base::Result<std::unique_ptr<Sensor>> {
    const auto settings = ReadPositioningSettings(description);
    if (!settings) return base::Fail(settings.error());
    return std::make_unique<Positioning>(description, *settings);
  };
  type.schema = &messages::SchemaOf<messages::geometry_msgs::PoseStamped>();
  type.encode = EncodePose;
  return type;
}

}  // namespace gsv::sensing
