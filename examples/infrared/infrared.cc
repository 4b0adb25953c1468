// A sensor type from outside the tree: an infrared proximity sensor, which throws light ahead and
// measures how much comes back.
//
//   cmake -S examples/infrared -B $B -D GSV_SOURCE_DIR=$PWD -D GSV_BUILD_DIR=$PWD/build/release
//   cmake --build $B
//   gsv run WORLD --robot MODEL --sensor-plugin $B/gsv-sensor-infrared.so
//
// Frame       sensor frame: the light goes along x.
// Model       by triangulation, as in Sharp's GP2Y0A21: the voltage is scale / (distance + offset).
// Parameters  min (0.1) and max (0.8), m; scale (0.27, V m) and offset (0.015, m); noise (m).
// Readings    values {distance (m), voltage (V)}; beyond max {infinity, 0}, nearer than min the
//             distance is min. As a message: sensor_msgs/Range, infrared.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/module.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"
#include "gsv/services/sensor_servants.h"
#include "infrared.hh"

namespace {

using namespace gsv;

class Infrared final : public sensing::Sensor {
 public:
  Infrared(const model::SensorDescription& description, sensing::ParameterReader& reader)
      : Sensor(description),
        min_(reader.Number("min", 0.1, 0, 10)),
        max_(reader.Number("max", 0.8, 0.01, 10)),
        scale_(reader.Number("scale", 0.27, 0, 100)),
        offset_(reader.Number("offset", 0.015, 1e-6, 10)),
        noise_(sensing::ReadNoise(reader, "noise", 10)) {
    if (min_ > max_) reader.Refuse("min is above max");
  }

  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    const geometry::Pose world_from_sensor = sampling.WorldFromSensor(description());
    double distance =
        sampling.Range({world_from_sensor.position,
                        world_from_sensor.orientation * geometry::Vector3{1, 0, 0}, max_});
    sensing::Reading reading = sampling.Stamped();
    if (!std::isfinite(distance)) {
      reading.values = {std::numeric_limits<double>::infinity(), 0};
      return reading;
    }
    distance = sensing::NoisyReading(sampling, description()).Read(noise_, 0, distance);
    distance = std::clamp(distance, min_, max_);
    reading.values = {distance, scale_ / (distance + offset_)};
    return reading;
  }
  bool CastsRays() const override { return true; }

  static messages::sensor_msgs::Range ToMessage(const model::SensorDescription& description,
                                                const sensing::Reading& reading,
                                                const std::string&) {
    messages::sensor_msgs::Range message;
    message.radiation_type = messages::sensor_msgs::Range::kInfrared;
    message.field_of_view = 0.05f;
    message.min_range = static_cast<float>(model::NumberOr(description.parameters, "min", 0.1));
    message.max_range = static_cast<float>(model::NumberOr(description.parameters, "max", 0.8));
    message.range = static_cast<float>(reading.values.empty() ? 0 : reading.values[0]);
    return message;
  }

 private:
  const double min_, max_, scale_, offset_;
  const sensing::NoiseModel noise_;
};

class InfraredServant final : public services::SensorServant<POA_infrared::ProximitySensor> {
 public:
  using SensorServant::SensorServant;
  CORBA::Double distance() override { return Read().values.at(0); }
  CORBA::Double voltage() override { return Read().values.at(1); }
};

base::Status Add(sensing::SensorRegistry& registry) {
  auto type = sensing::MakeSensorType<Infrared, messages::sensor_msgs::Range>("infrared");
  type.overlay = sensing::Overlay::kLines;
  type.beams = [](const model::SensorDescription&, const sensing::Reading& reading) {
    std::vector<sensing::Segment> beams;
    if (!reading.values.empty() && std::isfinite(reading.values[0])) {
      beams.push_back({{}, {reading.values[0], 0, 0}});
    }
    return beams;
  };
  services::SensorServants::Register("infrared", services::MakeSensorServant<InfraredServant>);
  return registry.Add(std::move(type));
}

}  // namespace

GSV_SENSOR_MODULE(Add)
