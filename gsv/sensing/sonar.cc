#include "gsv/sensing/sonar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/parameters.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

struct SonarSettings {
  double min = 0, max = 5;
  double field_of_view = 0.26;
};

base::Result<SonarSettings> ReadSettings(const model::SensorDescription& description) {
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
  if (!reader.status()) return base::Fail(reader.status().error());
  return settings;
}

class Sonar final : public Sensor {
 public:
  Sonar(const model::SensorDescription& description, const SonarSettings& settings)
      : Sensor(description), settings_(settings) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose world_from_sonar = sampling.WorldFromSensor(description());
    const Ray beam{world_from_sonar.position, world_from_sonar.orientation * Vector3{1, 0, 0},
                   settings_.max};
    const double echo = sampling.Range(beam);  // infinite: none
    base::Result<Reading> reading = sampling.Stamped();
    reading->values.push_back(echo >= settings_.min ? std::min(echo, settings_.max)
                                                    : settings_.max);
    return reading;
  }

  bool CastsRays() const override { return true; }

 private:
  SonarSettings settings_;
};

std::vector<std::uint8_t> Encode(const model::SensorDescription& description,
                                 const Reading& reading, const std::string& frame_id) {
  const SonarSettings settings = ReadSettings(description).value_or(SonarSettings{});
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
    const auto settings = ReadSettings(description);
    if (!settings) return base::Fail(settings.error());
    return std::make_unique<Sonar>(description, *settings);
  };
  type.schema = &messages::SchemaOf<messages::sensor_msgs::Range>();
  type.encode = Encode;
  type.overlay = Overlay::kLines;
  type.beams = [](const model::SensorDescription&, const Reading& reading) {
    std::vector<Segment> beams;
    for (const double range : reading.values) beams.push_back({{}, {range, 0, 0}});
    return beams;
  };
  return type;
}

}  // namespace gsv::sensing
