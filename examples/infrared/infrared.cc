// A sensor type outside of the source tree: an infrared proximity sensor, which emits light and
// measures the reflection.
//
//   cmake -S examples/infrared -B /tmp/infrared \
//         -D GSV_SOURCE_DIR=$PWD -D GSV_BUILD_DIR=$PWD/build/release
//   cmake --build /tmp/infrared
//   gsv run WORLD --robot MODEL --sensor-plugin /tmp/infrared/gsv-sensor-infrared.so
//
// Frame       sensor frame: the light points along x.
// Model       by triangulation, as in Sharp's GP2Y0A21: the voltage is scale / (distance + offset).
// Parameters  min (0.1) and max (0.8), m; scale (0.27, V m) and offset (0.015, m); noise (m).
// Readings    Proximity, below. As a message: sensor_msgs/Range, infrared.
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

// The layout of the sensor's readings.
struct Proximity {
  double distance = std::numeric_limits<double>::infinity();  // infinite if nothing is within max
  double voltage = 0;
  static constexpr auto kFields =
      std::make_tuple(readings::Value("distance", "m", &Proximity::distance, "range"),
                      readings::Value("voltage", "V", &Proximity::voltage));
};

class Infrared final : public sensing::SensorOf<Proximity, messages::sensor_msgs::Range> {
 public:
  Infrared(const model::SensorDescription& description, sensing::ParameterReader& reader)
      : SensorOf(description),
        min_(reader.Number("min", 0.1, 0, 10)),
        max_(reader.Number("max", 0.8, 0.01, 10)),
        scale_(reader.Number("scale", 0.27, 0, 100)),
        offset_(reader.Number("offset", 0.015, 1e-6, 10)),
        noise_(sensing::ReadNoise(reader, "noise", 10)) {
    if (min_ > max_) reader.Refuse("min is larger than max");
  }

  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    const geometry::Pose world_from_sensor = sampling.WorldFromSensor(description());
    double distance =
        sampling.Range({world_from_sensor.position,
                        world_from_sensor.orientation * geometry::Vector3{1, 0, 0}, max_});
    Proximity proximity;
    if (std::isfinite(distance)) {
      distance = sensing::NoisyReading(sampling, description()).Read(noise_, 0, distance);
      distance = std::clamp(distance, min_, max_);
      proximity = {distance, scale_ / (distance + offset_)};
    }
    sensing::Reading reading = sampling.Stamped();
    Fill(proximity, reading);
    return reading;
  }
  bool CastsRays() const override { return true; }

 private:
  Message ToMessage(const Values& proximity, const sensing::Reading&,
                    const std::string&) const override {
    Message message;
    message.radiation_type = Message::kInfrared;
    message.field_of_view = 0.05f;
    message.min_range = static_cast<float>(min_);
    message.max_range = static_cast<float>(max_);
    message.range = static_cast<float>(proximity.distance);
    return message;
  }

  std::vector<sensing::Segment> BeamsOf(const Values& proximity) const override {
    if (!std::isfinite(proximity.distance)) return {};
    return {{{}, {proximity.distance, 0, 0}}};
  }

  const double min_, max_, scale_, offset_;
  const sensing::NoiseModel noise_;
};

class InfraredServant final : public services::SensorServant<POA_infrared::ProximitySensor> {
 public:
  using SensorServant::SensorServant;
  CORBA::Double distance() override { return In<Proximity>(Read()).distance; }
  CORBA::Double voltage() override { return In<Proximity>(Read()).voltage; }
};

base::Status Add(sensing::SensorRegistry& registry) {
  services::SensorServants::Register("infrared", services::MakeSensorServant<InfraredServant>);
  return registry.Add(sensing::MakeSensorType<Infrared>("infrared", {}, sensing::Overlay::kLines));
}

}  // namespace

GSV_SENSOR_MODULE(Add)
