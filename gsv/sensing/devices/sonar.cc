#include "gsv/sensing/devices/sonar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/sound_cone.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/parameters.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

struct SonarSettings {
  double min = 0, max = 5;
  double field_of_view = 0.26;
  std::optional<SoundSettings> sound;  // of a cone
  NoiseModel noise;
};

base::Result<SonarSettings> ReadSonarSettings(const model::SensorDescription& description) {
  ParameterReader reader(description);
  SonarSettings settings;
  settings.min = reader.Number("min", settings.min, 0, 1e4);
  settings.max = reader.Number("max", settings.max, 1e-3, 1e4);
  const double radius = reader.Number("radius", 0, 0, 1e4);
  if (radius > 0) settings.field_of_view = 2 * std::atan(radius / settings.max);
  settings.field_of_view =
      reader.Number("field_of_view", settings.field_of_view, 0, std::numbers::pi);
  if (settings.min > settings.max) {
    reader.Refuse(fmt::format("min is {} and above max, {}", settings.min, settings.max));
  }
  settings.noise = ReadNoise(reader, "noise", 1e3);
  const std::string beam = reader.Text("beam", "ray");
  if (beam == "cone") {
    settings.sound = ReadSound(reader);
  } else if (beam != "ray") {
    reader.Refuse(fmt::format("beam is \"{}\"; it must be ray or cone", beam));
  }
  if (!reader.status()) return base::Fail(reader.status().error());
  return settings;
}

class Sonar final : public Sensor {
 public:
  Sonar(const model::SensorDescription& description, const SonarSettings& settings)
      : Sensor(description), settings_(settings) {
    if (settings.sound) cone_.emplace(*settings.sound);
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose world_from_sonar = sampling.WorldFromSensor(description());
    double echo = Echo(sampling, world_from_sonar);  // infinite: none
    if (!settings_.noise.is_none() && std::isfinite(echo)) {
      echo = NoisyReading(sampling, description()).Read(settings_.noise, 0, echo);
    }
    base::Result<Reading> reading = sampling.Stamped();
    reading->values.push_back(echo >= settings_.min ? std::min(echo, settings_.max)
                                                    : settings_.max);
    return reading;
  }

  bool CastsRays() const override { return true; }

 private:
  double Echo(const Sampling& sampling, const geometry::Pose& world_from_sonar) const {
    if (cone_) return cone_->NearestEcho(sampling, world_from_sonar, settings_.max);
    return sampling.Range({world_from_sonar.position,
                           world_from_sonar.orientation * Vector3{1, 0, 0}, settings_.max});
  }

  SonarSettings settings_;
  std::optional<SoundCone> cone_;
};

std::vector<std::uint8_t> EncodeRange(const model::SensorDescription& description,
                                      const Reading& reading, const std::string& frame_id) {
  const SonarSettings settings = ReadSonarSettings(description).value_or(SonarSettings{});
  messages::sensor_msgs::Range message;
  message.header = HeaderOf(reading, frame_id);
  message.radiation_type = messages::sensor_msgs::Range::kUltrasound;
  message.field_of_view = static_cast<float>(settings.field_of_view);
  message.min_range = static_cast<float>(settings.min);
  message.max_range = static_cast<float>(settings.max);
  message.range = reading.values.empty() ? 0.0f : static_cast<float>(reading.values[0]);
  return Encoded(message);
}

}  // namespace

SensorType SonarType() {
  SensorType type;
  type.name = "sonar";
  type.create =
      [](const model::SensorDescription& description) -> base::Result<std::unique_ptr<Sensor>> {
    const auto settings = ReadSonarSettings(description);
    if (!settings) return base::Fail(settings.error());
    return std::make_unique<Sonar>(description, *settings);
  };
  type.schema = &messages::SchemaOf<messages::sensor_msgs::Range>();
  type.encode = EncodeRange;
  type.overlay = Overlay::kLines;
  type.beams = [](const model::SensorDescription&, const Reading& reading) {
    std::vector<Segment> beams;
    for (const double range : reading.values) beams.push_back({{}, {range, 0, 0}});
    return beams;
  };
  return type;
}

}  // namespace gsv::sensing
