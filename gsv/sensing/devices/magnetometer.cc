#include "gsv/sensing/devices/magnetometer.h"

#include <array>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

constexpr double kDrawnLength = 0.3;  // m

class Magnetometer final : public Sensor {
 public:
  Magnetometer(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description),
        noise_{ReadNoise(reader, "x.noise", 1), ReadNoise(reader, "y.noise", 1),
               ReadNoise(reader, "z.noise", 1)} {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const Vector3 field = Inverse(sampling.WorldFromSensor(description()).orientation) *
                          sampling.snapshot()->layout->description->magnetic_field;
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    reading.values = {noisy.Read(noise_[0], 0, field.x), noisy.Read(noise_[1], 1, field.y),
                      noisy.Read(noise_[2], 2, field.z)};
    return reading;
  }

  static messages::sensor_msgs::MagneticField ToMessage(const model::SensorDescription&,
                                                        const Reading& reading,
                                                        const std::string&) {
    messages::sensor_msgs::MagneticField message;
    const auto& v = reading.values;
    if (v.size() == 3) message.magnetic_field = {v[0], v[1], v[2]};
    return message;
  }

 private:
  const std::array<NoiseModel, 3> noise_;
};

std::vector<Segment> FieldLines(const model::SensorDescription& description,
                                const Reading& reading) {
  if (!description.visualize || reading.values.size() != 3) return {};
  const auto& v = reading.values;
  return {{{}, kDrawnLength * geometry::Normalized(Vector3{v[0], v[1], v[2]})}};
}

}  // namespace

SensorType MagnetometerType() {
  SensorType type =
      MakeSensorType<Magnetometer, messages::sensor_msgs::MagneticField>("magnetometer");
  type.overlay = Overlay::kLines;
  type.beams = FieldLines;
  return type;
}

}  // namespace gsv::sensing
