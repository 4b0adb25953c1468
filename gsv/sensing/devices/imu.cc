#include "gsv/sensing/devices/imu.h"

#include <array>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/sensor_motion.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

constexpr double kDrawnPerForce = 0.03;  // m a m/s²

class Imu final : public Sensor {
 public:
  Imu(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description), has_orientation_(reader.Flag("enable_orientation", true)) {
    constexpr std::array kAxes = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string axis = kAxes[i];
      noise_[i] = ReadNoise(reader, "angular_velocity." + axis + ".noise", 1e4);
      noise_[i + 3] = ReadNoise(reader, "linear_acceleration." + axis + ".noise", 1e6);
    }
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const SensorMotion motion = MotionOf(sampling, description());
    const Quaternion& world_from_sensor = motion.world_from_sensor.orientation;
    const Quaternion sensor_from_world = Inverse(world_from_sensor);
    const Vector3 turning = sensor_from_world * motion.angular_velocity;
    const Vector3 force = sensor_from_world *
                          (motion.acceleration - sampling.snapshot()->layout->description->gravity);
    Reading reading = sampling.Stamped();
    reading.values = {turning.x, turning.y, turning.z, force.x, force.y, force.z};
    const NoisyReading noisy(sampling, description());
    for (std::size_t i = 0; i < noise_.size(); ++i) {
      reading.values[i] = noisy.Read(noise_[i], i, reading.values[i]);
    }
    if (has_orientation_) {
      for (const double q :
           {world_from_sensor.w, world_from_sensor.x, world_from_sensor.y, world_from_sensor.z}) {
        reading.values.push_back(q);
      }
    }
    return reading;
  }

  static messages::sensor_msgs::Imu ToMessage(const model::SensorDescription&,
                                              const Reading& reading, const std::string&) {
    messages::sensor_msgs::Imu message;
    const auto& v = reading.values;
    if (v.size() >= 6) {
      message.angular_velocity = {v[0], v[1], v[2]};
      message.linear_acceleration = {v[3], v[4], v[5]};
    }
    if (v.size() == 10) {
      message.orientation = {v[7], v[8], v[9], v[6]};
    } else {
      message.orientation_covariance[0] = -1;  // there is none
    }
    return message;
  }

 private:
  const bool has_orientation_;
  std::array<NoiseModel, 6> noise_;
};

std::vector<Segment> AccelerationLines(const model::SensorDescription& description,
                                       const Reading& reading) {
  if (!description.visualize || reading.values.size() < 6) return {};
  const auto& v = reading.values;
  return {{{}, kDrawnPerForce * Vector3{v[3], v[4], v[5]}}};
}

}  // namespace

SensorType ImuType() {
  SensorType type = MakeSensorType<Imu, messages::sensor_msgs::Imu>("imu");
  type.overlay = Overlay::kLines;
  type.beams = AccelerationLines;
  return type;
}

}  // namespace gsv::sensing
