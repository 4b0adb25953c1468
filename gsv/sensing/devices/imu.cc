#include "gsv/sensing/devices/imu.h"

#include <array>
#include <cmath>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/orientation_reference.h"
#include "gsv/sensing/devices/sensor_motion.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

constexpr double kDrawnPerForce = 0.03;  // length of the drawn line, m per m/s²
constexpr double kUsualRate = 100;       // in Hz, for a sensor without an update rate

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
    ReadAllan(reader, "angular_velocity", 1e4, 0);
    ReadAllan(reader, "linear_acceleration", 1e6, 3);
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const SensorMotion motion = MotionOf(sampling, description());
    const Quaternion& world_from_sensor = motion.world_from_sensor.orientation;
    const Quaternion sensor_from_world = Inverse(world_from_sensor);
    const Vector3 turning = sensor_from_world * motion.angular_velocity;
    const Vector3 force = sensor_from_world *
                          (motion.acceleration - sampling.snapshot()->layout->description->gravity);
    const NoisyReading noisy(sampling, description());
    const auto along_axis = [&](std::size_t channel, double value) {
      for (std::size_t i = 0; i < allan_.size(); ++i) {
        value = noisy.Read(allan_[i][channel / 3], 6 * (i + 1) + channel, value);
      }
      return noisy.Read(noise_[channel], channel, value);
    };
    const auto disturbed = [&](const Vector3& v, std::size_t channel) {
      return readings::Vector{along_axis(channel, v.x), along_axis(channel + 1, v.y),
                              along_axis(channel + 2, v.z)};
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
  // Reads the three parameters that an Allan plot shows. They apply to all three axes of
  // `quantity`.
  void ReadAllan(ParameterReader& reader, const std::string& quantity, double limit,
                 std::size_t first_channel) {
    // The parameter bias_instability is the lowest value of the Allan deviation. This value is
    // 0.664 times the standard deviation of a slowly drifting bias (IEEE 952).
    constexpr double kFloor = 0.664, kInstabilityTime = 100, kWalkTime = 3600;  // s
    const double density = reader.Number(quantity + ".noise_density", 0, 0, limit);
    const double instability = reader.Number(quantity + ".bias_instability", 0, 0, limit);
    const double walk = reader.Number(quantity + ".random_walk", 0, 0, limit);
    const double rate = description().update_rate > 0 ? description().update_rate : kUsualRate;
    NoiseModel& quick = allan_[0][first_channel / 3];
    quick.stddev = density * std::sqrt(rate);
    quick.drift_stddev = instability / kFloor;
    quick.drift_time = instability > 0 ? kInstabilityTime : 0;
    NoiseModel& slow = allan_[1][first_channel / 3];
    slow.drift_stddev = walk * std::sqrt(kWalkTime / 2);
    slow.drift_time = walk > 0 ? kWalkTime : 0;
  }

  Message ToMessage(const Values& motion, const Reading&, const std::string&) const override {
    Message message;
    const auto& [turning, force] = std::tie(motion.angular_velocity, motion.specific_force);
    message.angular_velocity = {turning.x, turning.y, turning.z};
    message.linear_acceleration = {force.x, force.y, force.z};
    if (const auto& q = motion.world_from_sensor) {
      message.orientation = {q->x, q->y, q->z, q->w};
    } else {
      message.orientation_covariance[0] = -1;  // there is no orientation
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
  // Noise models of the Allan parameters: allan_[term][quantity]. Term 0 is white noise and bias
  // instability, and term 1 is the random walk. Quantity 0 is the angular velocity, and quantity 1
  // is the specific force.
  std::array<std::array<NoiseModel, 2>, 2> allan_;
};

}  // namespace

SensorType ImuType() { return MakeSensorType<Imu>(readings::Imu::kType, {}, Overlay::kLines); }

}  // namespace gsv::sensing
