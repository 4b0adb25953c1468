#include "gsv/sensing/devices/imu.h"

#include <array>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/orientation_reference.h"
#include "gsv/sensing/devices/sensor_motion.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

constexpr double kDrawnPerForce = 0.03;  // m a m/s²

class Imu final : public SensorOf<readings::Imu, messages::sensor_msgs::Imu> {
 public:
  Imu(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        has_orientation_(reader.Flag("enable_orientation", true)),
        reference_(reader) {
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
    const NoisyReading noisy(sampling, description());
    const auto disturbed = [&](const Vector3& v, std::size_t channel) {
      return readings::Vector{noisy.Read(noise_[channel], channel, v.x),
                              noisy.Read(noise_[channel + 1], channel + 1, v.y),
                              noisy.Read(noise_[channel + 2], channel + 2, v.z)};
    };
    Values motion_felt{disturbed(turning, 0), disturbed(force, 3), std::nullopt};
    if (has_orientation_) {
      const auto& world = *sampling.snapshot()->layout->description;
      const Quaternion q = reference_.is_world()
                               ? world_from_sensor
                               : reference_.ReferenceFromWorld(world) * world_from_sensor;
      motion_felt.world_from_sensor = {q.w, q.x, q.y, q.z};
    }
    Reading reading = sampling.Stamped();
    Fill(motion_felt, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& motion, const Reading&, const std::string&) const override {
    Message message;
    const auto& [turning, force] = std::tie(motion.angular_velocity, motion.specific_force);
    message.angular_velocity = {turning.x, turning.y, turning.z};
    message.linear_acceleration = {force.x, force.y, force.z};
    if (const auto& q = motion.world_from_sensor) {
      message.orientation = {q->x, q->y, q->z, q->w};
    } else {
      message.orientation_covariance[0] = -1;  // there is none
    }
    return message;
  }

  std::vector<Segment> BeamsOf(const Values& motion) const override {
    if (!description().visualize) return {};
    const readings::Vector& force = motion.specific_force;
    return {{{}, kDrawnPerForce * Vector3{force.x, force.y, force.z}}};
  }

  const bool has_orientation_;
  const OrientationReference reference_;
  std::array<NoiseModel, 6> noise_;
};

}  // namespace

SensorType ImuType() { return MakeSensorType<Imu>(readings::Imu::kType, {}, Overlay::kLines); }

}  // namespace gsv::sensing
