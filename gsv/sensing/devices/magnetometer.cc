#include "gsv/sensing/devices/magnetometer.h"

#include <array>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

constexpr double kDrawnLength = 0.3;  // m

class Magnetometer final
    : public SensorOf<readings::Magnetometer, messages::sensor_msgs::MagneticField> {
 public:
  Magnetometer(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        noise_{ReadNoise(reader, "x.noise", 1), ReadNoise(reader, "y.noise", 1),
               ReadNoise(reader, "z.noise", 1)} {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const Vector3 field = Inverse(sampling.WorldFromSensor(description()).orientation) *
                          sampling.snapshot()->layout->description->magnetic_field;
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    Fill(Values{{noisy.Read(noise_[0], 0, field.x), noisy.Read(noise_[1], 1, field.y),
                 noisy.Read(noise_[2], 2, field.z)}},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& measured, const Reading&, const std::string&) const override {
    Message message;
    const readings::Vector& field = measured.field;
    message.magnetic_field = {field.x, field.y, field.z};
    return message;
  }

  std::vector<Segment> BeamsOf(const Values& measured) const override {
    if (!description().visualize) return {};
    const readings::Vector& field = measured.field;
    return {{{}, kDrawnLength * geometry::Normalized(Vector3{field.x, field.y, field.z})}};
  }

  const std::array<NoiseModel, 3> noise_;
};

}  // namespace

SensorType MagnetometerType() {
  return MakeSensorType<Magnetometer>(readings::Magnetometer::kType, {}, Overlay::kLines);
}

}  // namespace gsv::sensing
